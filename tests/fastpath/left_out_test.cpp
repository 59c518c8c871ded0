// D17, D8: what keeps out of an anti-cone whose wedges were left out. An octant stands for it.
#include "fastpath/visibility/labels/left_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "fastpath/visibility/points/numbers.h"

namespace clues::fastpath {
namespace {

class LeftOutOctant : public testing::Test {
 protected:
  LeftOutOctant() {
    octant_.add({{&x_, 1, &origin_}, {&y_, -1, &origin_}, {&z_, 1, &origin_}}, origin_.approximate());
    octant_.index();
  }

  bool misses(const Point& a, const Point& b) const {
    const ExactPoint from(a), to(b);
    return octant_.surely_misses(0, from.approximate(), to.approximate());
  }
  bool hull_misses(const Point& a, const Point& b) const {
    const std::array<IntervalBox, 2> hull{ExactPoint(a).approximate(), ExactPoint(b).approximate()};
    return octant_.surely_misses(hull);
  }

  const RoundedUp rounded_up_;
  const ExactPoint origin_{Point{0, 0, 0}}, e0_{Point{1, 0, 0}}, e1_{Point{0, 1, 0}}, e2_{Point{0, 0, 1}};
  const Plane x_{origin_, e1_, e2_}, y_{origin_, e0_, e2_}, z_{origin_, e0_, e1_};  // y_ looks down
  LeftOut octant_{hull(ExactPoint(Point{-4, -4, -4}).approximate(), ExactPoint(Point{-3, -3, -3}).approximate())};
};

TEST_F(LeftOutOctant, HoldsItsBorderExactly) {
  EXPECT_TRUE(octant_.holds(0, origin_));
  EXPECT_TRUE(octant_.holds(0, ExactPoint(Point{0, 1, 1})));
  EXPECT_TRUE(octant_.holds(0, ExactPoint(Point{3, 2, 1})));
  EXPECT_FALSE(octant_.holds(0, ExactPoint(Point{-0x1p-1060, 1, 1})));
  EXPECT_FALSE(octant_.holds(0, ExactPoint(Point{1, -1, 1})));
}

TEST_F(LeftOutOctant, IsMissedBySegmentsThatPassBeside) {
  EXPECT_TRUE(misses({-1, 1, 1}, {-2, 1, 1}));
  EXPECT_TRUE(misses({-2, 1, 1}, {1, -2, 1}));        // no facet has both ends behind it
  EXPECT_FALSE(hull_misses({-2, 1, 1}, {1, -2, 1}));  // of the facets none does it alone
  EXPECT_TRUE(hull_misses({-2, 1, 1}, {-1, -2, 1}));
}

TEST_F(LeftOutOctant, IsMetBySegmentsThatEndInItOrGoThrough) {
  EXPECT_FALSE(misses({-1, 2, 2}, {2, -0.5, 2}));
  EXPECT_FALSE(misses({-1, 1, 1}, {1, 1, 1}));
  EXPECT_FALSE(misses({-1, 1, 1}, {1, -1, 1}));  // through its edge
  EXPECT_FALSE(misses({1, 1, 1}, {2, 2, 2}));
}

// What is in A(x) is on a line from V through x, beyond x: no such x may be passed over.
TEST(LeftOut, NearAreAllOfWhoseAnticonesAnythingIsInTheBox) {
  const RoundedUp rounded_up;
  const ExactPoint origin(Point{0, 0, 0}), e0(Point{1, 0, 0}), e1(Point{0, 1, 0});
  const Plane plane(origin, e0, e1);
  std::mt19937_64 random(20261129);
  const auto part = [&random] { return static_cast<double>(random() % 4097) / 4096; };
  const auto boxed = [](const Point& p) { return ExactPoint(p).approximate(); };
  const Point low{-1, 2, 0}, high{1, 2.5, 3};
  LeftOut left_out(hull(boxed(low), boxed(high)));
  std::vector<Point> apexes;
  std::size_t passed_over = 0;
  for (const std::size_t more : {1, 40, 7}) {
    const std::size_t first = left_out.size();
    for (std::size_t i = 0; i < more; ++i) {
      apexes.push_back({16 * part() - 8, 16 * part() - 8, 16 * part() - 8});
      left_out.add({{&plane, 1, &origin}}, boxed(apexes.back()));
    }
    left_out.index();
    ASSERT_EQ(left_out.size(), apexes.size());
    for (std::size_t i = 0; i < apexes.size(); ++i) {
      for (int k = 0; k < 50; ++k) {
        Point z{};
        const double t = k % 5 == 0 ? 0 : std::exp2(8 * part() - 4);
        for (std::size_t c = 0; c < 3; ++c)
          z[c] = apexes[i][c] + t * (apexes[i][c] - (low[c] + part() * (high[c] - low[c])));
        std::vector<std::size_t> found;
        left_out.any_near(boxed(z), 0, [&](std::size_t n) {
          found.push_back(n);
          return false;
        });
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << i << " " << k;
        passed_over += apexes.size() - found.size();
        EXPECT_EQ(left_out.any_near(boxed(z), first, [&](std::size_t n) { return n == i; }), i >= first);
      }
    }
  }
  EXPECT_GT(passed_over, 10000U);
}

}  // namespace
}  // namespace clues::fastpath
