// Regions with holes and notches: the triangles fill them exactly, and the points lie inside.
#include "validate/certificates/region_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace clues::validate {
namespace {

using exact::FT;
using exact::Point3;

// In the plane x + y + z = 1, given by x and y.
std::vector<Point3> ring(const std::vector<std::array<int, 2>>& corners) {
  std::vector<Point3> points;
  for (const auto& [x, y] : corners) points.emplace_back(x, y, 1 - x - y);
  return points;
}

FT twice_area_in_xy(const ExactTriangle& t) {
  return (t[1].x() - t[0].x()) * (t[2].y() - t[0].y()) - (t[1].y() - t[0].y()) * (t[2].x() - t[0].x());
}

const Rings notched_with_hole{ring({{0, 0}, {8, 0}, {8, 8}, {4, 4}, {0, 8}}), ring({{2, 1}, {2, 2}, {4, 2}, {4, 1}})};

TEST(RegionPoints, TrianglesFillTheRegion) {
  FT area = 0;
  for (const auto& triangle : triangulate_region(notched_with_hole)) {
    EXPECT_GT(twice_area_in_xy(triangle), 0);
    area += twice_area_in_xy(triangle);
  }
  EXPECT_EQ(area, 2 * (64 - 16 - 2));
}

TEST(RegionPoints, ReversedRingsTurnTheTrianglesToo) {
  Rings reversed = notched_with_hole;
  for (auto& r : reversed) std::reverse(r.begin(), r.end());
  FT area = 0;
  for (const auto& triangle : triangulate_region(reversed)) area += twice_area_in_xy(triangle);
  EXPECT_EQ(area, -2 * (64 - 16 - 2));
}

TEST(RegionPoints, PointsAreInsideAndDifferent) {
  const auto points = interior_points(notched_with_hole, 50);
  EXPECT_EQ(points.size(), 50U);
  EXPECT_EQ(std::set<Point3>(points.begin(), points.end()).size(), 50U);
  for (const auto& p : points) {
    EXPECT_EQ(p.x() + p.y() + p.z(), 1);
    const bool in_outer = p.y() > 0 && p.x() > 0 && p.x() < 8 && (p.y() < p.x() || p.y() < 8 - p.x());
    const bool in_hole = p.x() >= 2 && p.x() <= 4 && p.y() >= 1 && p.y() <= 2;
    EXPECT_TRUE(in_outer && !in_hole) << p;
  }
}

TEST(RegionPoints, UprightRegion) {
  const Rings wall{{Point3(0, 0, 0), Point3(0, 3, 0), Point3(0, 3, 2), Point3(0, 0, 2)}};
  EXPECT_EQ(triangulate_region(wall).size(), 2U);
}

}  // namespace
}  // namespace clues::validate
