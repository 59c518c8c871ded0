// Short points: near what they stand for, and never a number that is none.
#include "exact/complex/simple_point.h"

#include <gtest/gtest.h>

namespace clues::exact {
namespace {

TEST(SimplePoint, IsNearerTheFinerTheLevel) {
  const FT x = FT(1) / FT(3);
  FT last(1);
  for (int level = 0; level < kSimpleLevels; ++level) {
    const FT off = CGAL::abs(simple_near(x, level) - x);
    EXPECT_LT(off, last);
    last = off;
  }
}

TEST(SimplePoint, WhatLiesBeyondTheDoublesStaysAsItIs) {
  const FT far = FT(0x1p1000) * FT(0x1p1000);
  for (int level = 0; level < kSimpleLevels; ++level) {
    EXPECT_EQ(simple_near(FT(0x1p1020), level), FT(0x1p1020));
    EXPECT_EQ(simple_near(far, level), far);
  }
}

TEST(SimplePoint, OfATriangleIsInsideIt) {
  const std::array<Point3, 3> t{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)};
  const auto p = simple_in_triangle(Point3(FT(1) / FT(3), FT(1) / FT(3), 0), t, 0);
  ASSERT_TRUE(p);
  EXPECT_TRUE(p->x() > 0 && p->y() > 0 && p->x() + p->y() < 1);
  EXPECT_FALSE(simple_in_triangle(Point3(FT(1) / FT(1000000), 0, 0), t, 0));  // rounding leaves the triangle
}

// What doubles make of this corner is beyond all bounds. Found by the coverage-guided fuzzer.
TEST(SimplePoint, OfASliverIsNoneRatherThanInfinite) {
  const std::array<Point3, 3> sliver{Point3(0, 0, 0), Point3(0, 0, 0x1p-1074), Point3(0, 1, 0)};
  for (int level = 0; level < kSimpleLevels; ++level) EXPECT_FALSE(simple_in_triangle(Point3(0, 0, 1), sliver, level));
}

}  // namespace
}  // namespace clues::exact
