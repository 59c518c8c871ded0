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

}  // namespace
}  // namespace clues::fastpath
