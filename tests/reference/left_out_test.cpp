// D17 in the reference: what holds the anti-cones of a whole part of an edge, and walks whose last leg is no part of a sight line.
#include <gtest/gtest.h>

#include <random>

#include "reference/visibility/labels/walk.h"
#include "reference/visibility/wedges/anticone.h"

namespace clues::reference {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;

exact::ConvexCell unit_box() {
  std::vector<scene::Point> corners;
  for (const double x : {0., 1.}) {
    for (const double y : {0., 1.}) {
      for (const double z : {0., 1.}) corners.push_back({x, y, z});
    }
  }
  return exact::ConvexCell::from_doubles(corners);
}

// An edge above the cell, over its border: the plane through it that touches V.
struct Edge {
  Point3 lo{1, -1, 2}, hi{1, 2, 2};
  Plane3 supporting{lo, hi, Point3(1, 0, 0)};
};

Edge above(const exact::ConvexCell& cell) {
  Edge e;
  if (e.supporting.has_on_positive_side(cell.center())) e.supporting = e.supporting.opposite();
  return e;
}

TEST(LeftOutParts, HoldTheAntiConesOfAllPointsBetween) {
  const exact::ConvexCell cell = unit_box();
  const Edge e = above(cell);
  LeftOut left_out;
  left_out.add(e.lo, e.hi, e.supporting, cell);
  std::mt19937_64 rng(20261123);
  std::uniform_int_distribution<int> number(0, 12);
  for (int i = 0; i < 500; ++i) {
    const Point3 y = e.lo + FT(number(rng)) / FT(12) * (e.hi - e.lo);
    Point3 in = y;
    for (const Point3& s : cell.vertices()) in = in + FT(number(rng)) / FT(5) * (y - s);
    EXPECT_TRUE(left_out.holds(0, in)) << in;
    EXPECT_TRUE(left_out.may_reach({in}));
  }
}

TEST(LeftOutParts, KeepToTheirSideOfTheEdge) {
  const exact::ConvexCell cell = unit_box();
  const Edge e = above(cell);
  LeftOut left_out;
  left_out.add(e.lo, e.hi, e.supporting, cell);
  EXPECT_FALSE(left_out.may_reach({Point3(0, 0, 4), Point3(FT(1) / FT(2), 1, 4)})) << "behind the supporting plane";
  EXPECT_FALSE(left_out.may_reach({Point3(2, 1, 1)})) << "lower than all of the edge, as V is";
  EXPECT_FALSE(left_out.may_reach({Point3(2, -50, 3)})) << "past the end, by more than the way from V leads";
  EXPECT_TRUE(left_out.may_reach({Point3(0, 0, 4), Point3(2, 0, 4)}));
  EXPECT_TRUE(left_out.meets(0, Point3(0, 0, 4), Point3(2, 0, 4)));
  EXPECT_FALSE(left_out.holds(0, Point3(0, 0, 4)));
  EXPECT_FALSE(left_out.meets(0, Point3(0, 0, 4), Point3(2, 0, -2))) << "out of one side before into the other";
}

TEST(LeftOutWalks, OnlyALegFromAGrooveOrACornerIsNoPartOfASightLine) {
  const exact::ConvexCell cell = unit_box();
  LeftOut left_out;
  left_out.add(Point3(1, 1, 2), cell);
  const Point3 before(FT(1) / FT(2), FT(1) / FT(2), 3), through(3, 3, 4), behind(9, 9, 3);
  ASSERT_TRUE(left_out.holds(0, through));
  ASSERT_FALSE(left_out.may_reach({before}));
  ASSERT_FALSE(left_out.may_reach({behind}));
  Walk walk;
  walk.legs.push_back({before, behind, 0, true, false, false});
  EXPECT_FALSE(walk.runs_through(left_out, 0));
  walk.legs.push_back({before, behind, 0, true, true, false});
  EXPECT_TRUE(walk.runs_through(left_out, 0)) << "its ends keep out, and its middle does not";
  walk.legs.back() = {before, behind, 0, true, false, true};
  EXPECT_TRUE(walk.runs_through(left_out, 0));
  walk.legs.back() = {before, Point3(-1, 0, 3), 0, true, true, false};
  EXPECT_FALSE(walk.runs_through(left_out, 0));
}

}  // namespace
}  // namespace clues::reference
