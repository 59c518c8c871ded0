// The tree over boxes against looking at every box: which boxes are found, for boxes that halve badly, and where segments run.
#include "fastpath/visibility/scene/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace clues::fastpath {
namespace {

constexpr std::uint64_t kScenesSeed = 20261122;

IntervalBox box_at(double x, double y, double z, double size) {
  return {Interval(x, x + size), Interval(y, y + size), Interval(z, z + size)};
}

// What the tree finds with a test, each item once.
template <class Test>
std::vector<std::uint32_t> found(const BoxTree& tree, const Test& test) {
  std::vector<std::uint32_t> items;
  EXPECT_FALSE(tree.any(test, [&](std::uint32_t i) {
    items.push_back(i);
    return false;
  }));
  std::sort(items.begin(), items.end());
  return items;
}

TEST(LocalBoxTree, FindsWhatLookingAtEveryBoxFinds) {
  const RoundedUp rounded_up;
  std::mt19937_64 random(kScenesSeed);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::function<IntervalBox(int)> kinds[] = {
      [](int) { return box_at(1, 2, 3, 1); },                       // all the same
      [](int i) { return box_at(std::ldexp(1.0, i), 0, 0, 0); },    // half of the way cuts off one at a time
      [](int i) { return box_at(i % 2 == 0 ? 0 : 1e9, 0, 0, 1); },  // two places
      [&](int) { return box_at(unit(random), unit(random), unit(random), 0.1); },
  };
  for (const auto& kind : kinds) {
    for (int count = 0; count < 70; ++count) {
      std::vector<IntervalBox> boxes;
      for (int i = 0; i < count; ++i) boxes.push_back(kind(i));
      const BoxTree tree(boxes);
      ASSERT_EQ(tree.size(), boxes.size());
      ASSERT_EQ(found(tree, [](const IntervalBox&) { return true; }).size(), boxes.size());
      for (const IntervalBox& wanted : boxes) {
        const auto test = [&](const IntervalBox& b) { return overlap(b, wanted); };
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
          if (test(boxes[i])) expected.push_back(i);
        }
        ASSERT_EQ(found(tree, test), expected) << count << " boxes";
      }
    }
  }
}

TEST(LocalBoxTree, ASegmentIsNeverSaidToMissABoxThatHoldsAPointOfIt) {
  const RoundedUp rounded_up;
  std::mt19937_64 random(kScenesSeed);
  std::uniform_real_distribution<double> unit(-1, 1);
  int missed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 40) - 20), far = random() % 2 == 0 ? 0 : 1e6;
    const auto point = [&] {
      return Point{far + scale * unit(random), scale * unit(random), far - scale * unit(random)};
    };
    const ExactPoint a(point()), b(point());
    const ExactPoint on = ExactPoint::between(a, b, std::fabs(unit(random)));
    EXPECT_TRUE(SegmentTest(a, b)(on.approximate()));
    missed += SegmentTest(a, b)(box_at(far + scale * unit(random), scale * unit(random), far, scale / 8)) ? 0 : 1;
  }
  EXPECT_GT(missed, 10000);  // it is of some use
}

// Through a corner of a box and away from it, along axes, too: exactly, so that any error that is not bounded would show.
TEST(LocalBoxTree, ASegmentIsNeverSaidToMissABoxOfWhichItMeetsACorner) {
  const RoundedUp rounded_up;
  std::mt19937_64 random(kScenesSeed);
  int missed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double far = random() % 2 == 0 ? 0 : 0x1p40, unit = std::ldexp(1.0, static_cast<int>(random() % 12));
    const auto number = [&](int most) {
      return static_cast<double>(static_cast<int>(random() % (2 * most + 1)) - most);
    };
    Point corner, a, b, other;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = number(3);
      corner[k] = far + number(1000);
      a[k] = corner[k] - unit * along;
      b[k] = corner[k] + unit * along;
      other[k] = corner[k] + number(100);
    }
    const auto box_between = [](const Point& p, const Point& q) {
      return hull(ExactPoint(p).approximate(), ExactPoint(q).approximate());
    };
    const SegmentTest test{ExactPoint(a), ExactPoint(b)};
    EXPECT_TRUE(test(box_between(corner, other)));
    const Point beside{other[0] + 1, other[1], other[2]};
    missed += test(box_between(other, beside)) ? 0 : 1;
  }
  EXPECT_GT(missed, 10000);
}

}  // namespace
}  // namespace clues::fastpath
