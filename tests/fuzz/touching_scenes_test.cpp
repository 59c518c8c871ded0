// The generators of geometry that meets the cell: pure, small, and in contact with cells of every dimension as they say, counted exactly.
#include "fuzz/generators/touching_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "exact/sight/scene_query.h"
#include "fuzz/generators/cell_shapes.h"

namespace clues::fuzz {
namespace {

constexpr std::uint64_t kScenesSeed = 20261122, kTouching = 64;

TEST(CellShapes, AreConvexWithTheFacesTheySay) {
  std::map<int, int> dimensions;
  for (int kind = 0; kind < cell_kinds; ++kind) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      SCOPED_TRACE(std::to_string(kind) + " " + std::to_string(i));
      Random random(kScenesSeed + i);
      const CellShape shape = cell_shape(kind, random);
      const auto cell = exact::ConvexCell::from_doubles(shape.vertices);
      EXPECT_EQ(cell.dimension(), shape.dimension);
      EXPECT_EQ(cell.vertices().size(), shape.vertices.size());  // all are extreme
      EXPECT_EQ(cell.edges().size(), shape.edges.size());
      EXPECT_EQ(cell.facets().size(), shape.faces.size());
      for (const auto& p : shape.vertices) {
        for (const double x : p) {
          EXPECT_EQ(x, std::floor(x));
          EXPECT_LE(std::abs(x), 16);
        }
      }
      ++dimensions[shape.dimension];
    }
  }
  EXPECT_EQ(dimensions, (std::map<int, int>{{0, 40}, {1, 80}, {2, 120}, {3, 80}}));
}

TEST(TouchingScenes, ArePureAndWithinBounds) {
  for (const auto& g : touching_generators()) {
    for (std::uint64_t i = 0; i < kTouching; ++i) {
      SCOPED_TRACE(std::string(g.name) + " " + std::to_string(i));
      const GeneratedScene scene = g.make(kScenesSeed, i), again = g.make(kScenesSeed, i);
      EXPECT_EQ(scene.mesh.points, again.mesh.points);
      EXPECT_EQ(scene.mesh.triangles, again.mesh.triangles);
      EXPECT_EQ(scene.cell, again.cell);
      EXPECT_EQ(scene.mesh.triangles.size(), scene.mesh.face_of.size());
      EXPECT_GE(scene.mesh.triangles.size(), 1U);
      EXPECT_LE(scene.mesh.triangles.size(), 10U);
      EXPECT_TRUE(scene::degenerate_triangles(scene.mesh).empty());
      for (const auto& p : scene.mesh.points) {
        for (const double x : p) {
          EXPECT_EQ(x * 1024, std::floor(x * 1024));
          EXPECT_LE(std::abs(x), 128);
        }
      }
    }
  }
}

std::map<std::string, int> places_of(const GeneratedScene& scene) {
  const auto cell = exact::ConvexCell::from_doubles(scene.cell);
  std::map<std::string, int> found;
  for (const auto& t : scene.mesh.triangles) {
    std::array<exact::Point3, 3> c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = exact::to_exact(scene.mesh.points[t[i]]);
    found["meets"] += exact::meets_cell(c, cell);
    int on = 0;
    for (const auto& p : c) {
      found["vertex inside"] += cell.interior_contains(p);
      found["vertex on the rim"] += cell.contains(p) && !cell.interior_contains(p);
      on += cell.contains(p);
    }
    found["edge on the cell"] += on >= 2;
    for (const auto& f : cell.facets())
      found["in a plane of the cell"] += f.plane.has_on(c[0]) && f.plane.has_on(c[1]) && f.plane.has_on(c[2]);
    for (const auto& [a, b] : cell.edges()) {
      const auto &p = cell.vertices()[static_cast<std::size_t>(a)], &q = cell.vertices()[static_cast<std::size_t>(b)];
      for (std::size_t i = 0; i < 3; ++i)
        found["edge in line"] += CGAL::collinear(p, q, c[i]) && CGAL::collinear(p, q, c[(i + 1) % 3]);
    }
    // Edges off the cell whose lines go through a vertex of it.
    for (const auto& s : cell.vertices()) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (!cell.contains(c[i]) && !cell.contains(c[(i + 1) % 3]))
          found["line through a corner"] += CGAL::collinear(s, c[i], c[(i + 1) % 3]);
      }
    }
  }
  return found;
}

TEST(TouchingScenes, MeetCellsOfEveryDimensionInEveryWay) {
  std::map<int, std::map<std::string, int>> by_dimension;
  std::map<std::string, int> meeting;  // scenes with contact, by generator
  for (const auto& g : touching_generators()) {
    for (std::uint64_t i = 0; i < kTouching; ++i) {
      const GeneratedScene scene = g.make(kScenesSeed, i);
      const auto places = places_of(scene);
      auto& sum = by_dimension[exact::ConvexCell::from_doubles(scene.cell).dimension()];
      for (const auto& [what, times] : places) sum[what] += times;
      meeting[g.name] += places.at("meets") > 0;
    }
  }
  for (int dimension = 0; dimension <= 3; ++dimension) {
    auto& found = by_dimension[dimension];
    std::vector<std::string> ways{"meets", "line through a corner", "vertex on the rim"};
    if (dimension == 0) ways = {"meets", "line through a corner", "vertex inside"};
    if (dimension > 0) ways.insert(ways.end(), {"vertex inside", "edge on the cell", "edge in line"});
    if (dimension > 1) ways.emplace_back("in a plane of the cell");
    for (const auto& way : ways) EXPECT_GT(found[way], 10) << way << ", dimension " << dimension;
  }
  for (const char* name : {"rim_fans", "stands_on_cell", "crosses_cell", "leaves_cell"})
    EXPECT_GT(meeting[name], static_cast<int>(kTouching / 2)) << name;
}

}  // namespace
}  // namespace clues::fuzz
