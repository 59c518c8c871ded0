// D17, D8: what keeps out of an anti-cone whose wedges were left out. An octant stands for it.
#include "fastpath/visibility/labels/left_out.h"

#include <gtest/gtest.h>

#include <array>

#include "fastpath/visibility/points/numbers.h"

namespace clues::fastpath {
namespace {

class LeftOutOctant : public testing::Test {
 protected:
  LeftOutOctant() { octant_.add({{&x_, 1, &origin_}, {&y_, -1, &origin_}, {&z_, 1, &origin_}}); }

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
  LeftOut octant_;
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

}  // namespace
}  // namespace clues::fastpath
