// D2: exact view cells of every dimension, independent of the order of their points.
#include "exact/cell/convex_cell.h"

#include "exact/sight/scene_query.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fuzz/generators/random.h"
#include "scene/messages/error.h"

namespace clues::exact {
namespace {

std::vector<Point3> cube(int size) {
  std::vector<Point3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back((i & 1) * size, (i >> 1 & 1) * size, (i >> 2 & 1) * size);
  return points;
}

void expect_polytope(const ConvexCell& cell) {
  for (const CellFacet& facet : cell.facets()) {
    std::vector<int> on_plane;
    for (int i = 0; i < static_cast<int>(cell.vertices().size()); ++i) {
      const auto& v = cell.vertices()[static_cast<std::size_t>(i)];
      EXPECT_FALSE(facet.plane.has_on_positive_side(v));
      if (facet.plane.has_on(v)) on_plane.push_back(i);
    }
    auto corners = facet.corners;
    EXPECT_EQ(corners.front(), *std::min_element(corners.begin(), corners.end()));
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = [&](std::size_t k) { return cell.vertices()[static_cast<std::size_t>(corners[k % n])]; };
      EXPECT_GT(facet.plane.orthogonal_vector() * CGAL::cross_product(at(i + 1) - at(i), at(i + 2) - at(i + 1)), FT(0));
    }
    std::sort(corners.begin(), corners.end());
    EXPECT_EQ(corners, on_plane);
  }
}

TEST(ConvexCell, CubeWithExtraPointsHasTwelveEdgesAndSixQuads) {
  auto points = cube(2);
  points.insert(points.end(), {Point3(1, 1, 2), Point3(1, 1, 1), Point3(1, 0, 0), Point3(2, 2, 2)});
  const ConvexCell cell(points);
  EXPECT_EQ(cell.dimension(), 3);
  EXPECT_EQ(cell.vertices().size(), 8U);
  EXPECT_EQ(cell.edges().size(), 12U);
  ASSERT_EQ(cell.facets().size(), 6U);
  for (const auto& facet : cell.facets()) EXPECT_EQ(facet.corners.size(), 4U);
  expect_polytope(cell);
  EXPECT_EQ(cell.center(), Point3(1, 1, 1));
  EXPECT_TRUE(cell.contains(Point3(2, 1, 1)));
  EXPECT_FALSE(cell.interior_contains(Point3(2, 1, 1)));
  EXPECT_TRUE(cell.interior_contains(Point3(FT(1) / FT(3), 1, 1)));
  EXPECT_FALSE(cell.contains(Point3(FT(2) + FT(1) / FT(1000000007), 1, 1)));
}

TEST(ConvexCell, TheOrderOfThePointsDoesNotMatter) {
  fuzz::Random random(11);
  for (int round = 0; round < 40; ++round) {
    std::vector<Point3> points;
    for (int i = 0; i < 14; ++i) points.emplace_back(random.between(0, 4), random.between(0, 4), random.between(0, 4));
    const ConvexCell cell(points);
    if (cell.dimension() != 3) continue;
    expect_polytope(cell);
    // Euler's relation.
    EXPECT_EQ(cell.vertices().size() + cell.facets().size(), cell.edges().size() + 2);
    for (const Point3& p : points) EXPECT_TRUE(cell.contains(p));
    EXPECT_TRUE(cell.interior_contains(cell.center()));
    for (std::size_t i = points.size() - 1; i > 0; --i) {
      std::swap(points[i], points[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
    }
    const ConvexCell again(points);
    EXPECT_EQ(cell.vertices(), again.vertices());
    EXPECT_EQ(cell.edges(), again.edges());
    ASSERT_EQ(cell.facets().size(), again.facets().size());
    for (std::size_t i = 0; i < cell.facets().size(); ++i) {
      EXPECT_EQ(cell.facets()[i].corners, again.facets()[i].corners);
    }
  }
}

TEST(ConvexCell, APolygonKeepsTheGivenOrientation) {
  const std::vector<scene::Point> square{{0, 0, 1}, {2, 0, 1}, {1, 0, 1}, {2, 2, 1}, {0, 2, 1}, {1, 1, 1}};
  const auto up = ConvexCell::from_doubles(square);
  EXPECT_EQ(up.dimension(), 2);
  EXPECT_EQ(up.vertices().size(), 4U);
  EXPECT_EQ(up.edges().size(), 4U);
  ASSERT_EQ(up.facets().size(), 1U);
  EXPECT_GT(up.facets()[0].plane.c(), FT(0));
  const auto down = ConvexCell::from_doubles({square.rbegin(), square.rend()});
  EXPECT_LT(down.facets()[0].plane.c(), FT(0));
  EXPECT_TRUE(up.interior_contains(Point3(1, 1, 1)));
  EXPECT_FALSE(up.interior_contains(Point3(1, 0, 1)));
  EXPECT_TRUE(up.contains(Point3(1, 0, 1)));
  EXPECT_FALSE(up.contains(Point3(1, 1, 2)));
}

TEST(ConvexCell, SegmentsAndPoints) {
  const auto segment = ConvexCell::from_doubles({{1, 1, 1}, {3, 3, 3}, {2, 2, 2}});
  EXPECT_EQ(segment.dimension(), 1);
  EXPECT_EQ(segment.edges().size(), 1U);
  EXPECT_TRUE(segment.interior_contains(Point3(2, 2, 2)));
  EXPECT_FALSE(segment.interior_contains(Point3(1, 1, 1)));
  EXPECT_TRUE(segment.contains(Point3(1, 1, 1)));
  EXPECT_FALSE(segment.contains(Point3(2, 2, 3)));
  const auto point = ConvexCell::from_doubles({{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(point.dimension(), 0);
  EXPECT_TRUE(point.interior_contains(Point3(1, 2, 3)));
  EXPECT_FALSE(point.contains(Point3(1, 2, 4)));
}

TEST(ConvexCell, InteriorPointsAreWeightedAndChecked) {
  const ConvexCell cell(cube(1));
  EXPECT_TRUE(cell.interior_contains(cell.interior_point(std::vector<int>{1, 1000000, 1, 1, 1, 1, 1, 1})));
  EXPECT_THROW(cell.interior_point(std::vector<int>{1, 0, 1, 1, 1, 1, 1, 1}), scene::Error);
  EXPECT_THROW(cell.interior_point(std::vector<int>{1}), scene::Error);
  EXPECT_THROW(ConvexCell({}), scene::Error);
}

TEST(Kernel, ExactTextIsInLowestTerms) {
  EXPECT_EQ(to_string_exact(FT(6) / FT(-4)), "-3/2");
  EXPECT_EQ(to_string_exact(FT(0.125) * FT(8)), "1");
  EXPECT_EQ(to_string_exact(FT(0.1)), "3602879701896397/36028797018963968");
  EXPECT_EQ(to_string_exact(collapsed(FT(1) / FT(3) + FT(1) / FT(6))), "1/2");
  EXPECT_EQ(collapsed(Point3(FT(1) / FT(3), 0, 1)), Point3(FT(1) / FT(3), 0, 1));
}

TEST(MeetsCell, EveryDimension) {
  const TriangleCorners t{Point3(0, 0, 0), Point3(4, 0, 0), Point3(0, 4, 0)};
  const auto cell = [](const std::vector<scene::Point>& points) { return ConvexCell::from_doubles(points); };
  EXPECT_TRUE(meets_cell(t, cell({{1, 1, 0}})));
  EXPECT_FALSE(meets_cell(t, cell({{1, 1, 0x1p-60}})));
  EXPECT_TRUE(meets_cell(t, cell({{1, 1, -1}, {1, 1, 1}})));
  EXPECT_FALSE(meets_cell(t, cell({{3, 3, -1}, {3, 3, 1}})));
  EXPECT_TRUE(meets_cell(t, cell({{-1, 1, -1}, {9, 1, -1}, {1, 1, 5}})));
  EXPECT_TRUE(meets_cell(t, cell({{0, 0, -1}, {-1, 0, -2}, {0, -1, -2}, {0, 0, 0}})));  // touches at a corner
  // The triangle pierces the box without a corner in it; the box holds the triangle; they are apart.
  EXPECT_TRUE(meets_cell({Point3(-9, -9, 1), Point3(9, -9, 1), Point3(0, 9, 1)},
                         cell({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}})));
  EXPECT_TRUE(meets_cell(t, cell({{-9, -9, -9}, {99, -9, -9}, {-9, 99, -9}, {-9, -9, 99}})));
  EXPECT_FALSE(meets_cell(t, cell({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 3}})));
}

}  // namespace
}  // namespace clues::exact
