// Routes of recorded camera paths, and which cells touch.
#include <gtest/gtest.h>

#include "exact/cell/touching.h"
#include "reference/streams/camera_route.h"
#include "scene/messages/error.h"
#include "scene/stream/route.h"
#include "tests/reference/support.h"

namespace clues::test {
namespace {

using exact::Point3;
using Route = std::vector<std::uint32_t>;

std::vector<exact::ConvexCell> grid_cells() {
  std::vector<exact::ConvexCell> cells;
  for (const auto& spec : scene::parse_cells("grid:2x2x1:box:0,0,0,2,2,1"))
    cells.push_back(exact::ConvexCell::from_doubles(spec.points));
  return cells;
}
std::vector<std::vector<std::uint32_t>> grid_neighbours() {
  return scene::neighbours_of(scene::parse_cells("grid:2x2x1:box:0,0,0,2,2,1"));
}
Route route_of(const std::vector<Point3>& path) {
  return reference::camera_route(grid_cells(), grid_neighbours(), path);
}

TEST(CameraRoute, GoesThroughTheCellsOfThePath) {
  const Point3 a(0.5, 0.5, 0.5), b(1.5, 0.5, 0.5), c(1.5, 1.5, 0.5);
  EXPECT_EQ(route_of({a}), (Route{0}));
  EXPECT_EQ(route_of({a, b, c}), (Route{0, 1, 3}));
  EXPECT_EQ(route_of({a, b, a}), (Route{0, 1, 0}));
  EXPECT_EQ(route_of({a, Point3(1, 0.5, 0.5), a}), (Route{0}));  // touches the border
  EXPECT_EQ(route_of({a, Point3(1, 0.5, 0.5), b}), (Route{0, 1}));
  EXPECT_EQ(route_of({Point3(0, 1, 0.5), Point3(2, 1, 0.5)}).size(), 2U);  // along a border of all four
}

// Through the edge in which four cells meet: by way of one that shares a face with both.
TEST(CameraRoute, GoesAroundACornerByAFace) {
  const Route route = route_of({Point3(0.5, 0.5, 0.5), Point3(1.5, 1.5, 0.5)});
  ASSERT_EQ(route.size(), 3U);
  EXPECT_EQ(route.front(), 0U);
  EXPECT_EQ(route.back(), 3U);
}

TEST(CameraRoute, RefusesAPathThatLeavesTheCells) {
  EXPECT_THROW(route_of({Point3(-1, 0, 0)}), scene::Error);
  EXPECT_THROW(route_of({Point3(0.5, 0.5, 0.5), Point3(0.5, 3, 0.5)}), scene::Error);
  EXPECT_THROW(route_of({Point3(2, 2, 0.5), Point3(3, 3, 0.5)}), scene::Error);
}

TEST(CameraRoute, StaysAsLongAsItCanWhereCellsOverlap) {
  const std::vector<exact::ConvexCell> cells{box_cell(0, 0, 0, 2, 1, 1), box_cell(1, 0, 0, 3, 1, 1),
                                             box_cell(1.5, 0, 0, 5, 1, 1)};
  const auto neighbours = exact::touching_cells(cells);
  EXPECT_EQ(neighbours, (std::vector<Route>{{1, 2}, {0, 2}, {0, 1}}));
  const std::vector<Point3> path{Point3(0.5, 0.5, 0.5), Point3(4, 0.5, 0.5)};
  EXPECT_EQ(reference::camera_route(cells, neighbours, path), (Route{0, 2}));
}

TEST(TouchingCells, ShareAPointAtLeast) {
  const std::vector<exact::ConvexCell> cells{
      box_cell(0, 0, 0, 1, 1, 1),            // of the others
      box_cell(1, 0.5, 0, 2, 2, 1),          // a part of a face
      box_cell(1, 1, 1, 2, 2, 2),            // a corner
      box_cell(1.0000001, 0, 0, 2, 0.4, 1),  // nothing
      exact::ConvexCell({Point3(1.9, 1.9, 0), Point3(3, 0, 0), Point3(3, 3, 0), Point3(3, 3, 1)})};
  const auto touching = exact::touching_cells(cells);
  EXPECT_EQ(touching[0], (Route{1, 2}));
  EXPECT_EQ(touching[3], (Route{}));
  EXPECT_EQ(touching[1], (Route{0, 2, 4}));
}

}  // namespace
}  // namespace clues::test
