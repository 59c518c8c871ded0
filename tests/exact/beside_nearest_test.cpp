// Where a viewer stands next to the point of V nearest to x: inside V, about as far from there as x.
#include "exact/cell/beside_nearest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/cell/convex_cell.h"

namespace clues::exact {
namespace {

double distance(const Point3& a, const scene::Point& b) {
  const scene::Point p = to_double_estimate(a);
  return std::hypot(p[0] - b[0], p[1] - b[1], p[2] - b[2]);
}

// x is over a vertex, an edge and the inside of a facet; `nearest` is known.
void expect_beside(const std::vector<scene::Point>& vertices, const scene::Point& x, const scene::Point& nearest) {
  const ConvexCell cell = ConvexCell::from_doubles(vertices);
  std::vector<scene::Point> corners;
  for (const Point3& v : cell.vertices()) corners.push_back(to_double_estimate(v));
  const double far = std::hypot(x[0] - nearest[0], x[1] - nearest[1], x[2] - nearest[2]);
  const auto found = weights_beside_nearest(corners, x, 0, 200);
  EXPECT_EQ(found.size(), 200U);
  for (const std::vector<double>& weights : found) {
    ASSERT_EQ(weights.size(), corners.size());
    const Point3 v = cell.interior_point(weights);
    EXPECT_TRUE(cell.interior_contains(v));
    EXPECT_LE(distance(v, nearest), 2.0001 * far);
  }
}

TEST(BesideNearest, IsInsideTheCellAndAsNearAsThePointIs) {
  const std::vector<scene::Point> cube{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const double e = 0x1p-20;
  expect_beside(cube, {1 + e, 1 + e, 1 + e}, {1, 1, 1});
  expect_beside(cube, {1 + e, 0.25, 1 + e}, {1, 0.25, 1});
  expect_beside(cube, {0.75, 0.25, 1 + e}, {0.75, 0.25, 1});
  const std::vector<scene::Point> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  expect_beside(square, {0.75, 0.25, -e}, {0.75, 0.25, 0});
  expect_beside(square, {-e, 0.25, e}, {0, 0.25, 0});
  expect_beside({{0, 0, 0}, {4, 0, 0}}, {3, e, 0}, {3, 0, 0});
}

// All around the place where x is beneath the middle of a square: in every quarter.
TEST(BesideNearest, LooksInEveryDirection) {
  const std::vector<scene::Point> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const ConvexCell cell = ConvexCell::from_doubles(square);
  std::vector<scene::Point> corners;
  for (const Point3& v : cell.vertices()) corners.push_back(to_double_estimate(v));
  std::array<int, 4> met{};
  for (const std::vector<double>& weights : weights_beside_nearest(corners, {0.5, 0.5, 0x1p-10}, 0, 200)) {
    const scene::Point v = to_double_estimate(cell.interior_point(weights));
    ++met[(v[0] > 0.5 ? 1U : 0U) + (v[1] > 0.5 ? 2U : 0U)];
  }
  for (const int n : met) EXPECT_GE(n, 20);
}

TEST(BesideNearest, SaysNothingUponTheCellAndFarFromIt) {
  EXPECT_TRUE(weights_beside_nearest({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {9, 9, 9}, 1, 4).empty());
  EXPECT_TRUE(weights_beside_nearest({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.25, 0.25, 0}, 1, 4).empty());
  EXPECT_TRUE(weights_beside_nearest({{2, 0, 0}}, {3, 0, 0}, 1, 4).empty());
}

}  // namespace
}  // namespace clues::exact
