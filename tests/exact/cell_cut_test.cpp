// Cells cut by planes.
#include "exact/complex/cell_cut.h"

#include <gtest/gtest.h>

namespace clues::tests {
namespace {

using exact::ConvexCell;
using exact::part_beside;
using exact::Plane3;
using exact::Point3;
using exact::Side;

ConvexCell hull(const std::vector<scene::Point>& points) { return ConvexCell::from_doubles(points); }

TEST(CellCut, ABoxIntoTwo) {
  const ConvexCell cube =
      hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}});
  const auto below = part_beside(cube, Plane3(3, 0, 0, -1), Side::negative);
  ASSERT_TRUE(below);
  EXPECT_EQ(below->dimension(), 3);
  EXPECT_EQ(below->vertices().size(), 8U);
  for (const Point3& v : below->vertices()) EXPECT_LE(3 * v.x(), 1);
  const auto corner = part_beside(cube, Plane3(2, 2, 2, -1), Side::negative);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->vertices().size(), 4U) << "a tetrahedron at the origin";
}

TEST(CellCut, AParallelPlaneBesideTheCellLeavesAllOrNothing) {
  const ConvexCell square = hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  EXPECT_FALSE(part_beside(square, Plane3(1, 0, 0, 0), Side::negative)) << "only an edge is on that side";
  EXPECT_EQ(part_beside(square, Plane3(1, 0, 0, 0), Side::positive)->vertices().size(), 4U);
  EXPECT_FALSE(part_beside(square, Plane3(0, 0, 1, 0), Side::positive)) << "the cell lies in the plane";
}

TEST(CellCut, EveryDimensionIsKept) {
  const ConvexCell square = hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(part_beside(square, Plane3(1, 1, 0, -1), Side::negative)->dimension(), 2);
  EXPECT_EQ(part_beside(square, Plane3(1, 1, 0, -1), Side::negative)->vertices().size(), 3U);
  const ConvexCell segment = hull({{0, 0, 0}, {4, 0, 0}});
  const auto half = part_beside(segment, Plane3(1, 0, 0, -1), Side::positive);
  EXPECT_EQ(half->vertices(), (std::vector<Point3>{Point3(1, 0, 0), Point3(4, 0, 0)}));
  const ConvexCell point = hull({{1, 2, 3}});
  EXPECT_TRUE(part_beside(point, Plane3(1, 0, 0, 0), Side::positive));
  EXPECT_FALSE(part_beside(point, Plane3(1, 0, 0, 0), Side::negative));
}

}  // namespace
}  // namespace clues::tests
