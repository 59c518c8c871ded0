// The generators of named degeneracies: pure, within their bounds, and degenerate in the way that they say, counted exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "fuzz/generators/degenerate_scenes.h"
#include "tests/seed.h"

namespace clues::fuzz {
namespace {

constexpr std::uint64_t kScenes = 24;

const DegenerateGenerator& named(const std::string& name) {
  for (const auto& g : degenerate_generators()) {
    if (g.name == name) return g;
  }
  throw std::runtime_error("no generator " + name);
}

TEST(DegenerateScenes, ArePureAndWithinBounds) {
  for (const auto& g : degenerate_generators()) {
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      SCOPED_TRACE(std::string(g.name) + " " + std::to_string(i));
      const GeneratedScene scene = g.make(kSeed, i), again = g.make(kSeed, i);
      EXPECT_EQ(scene.mesh.points, again.mesh.points);
      EXPECT_EQ(scene.mesh.triangles, again.mesh.triangles);
      EXPECT_EQ(scene.cell, again.cell);
      EXPECT_EQ(scene.mesh.triangles.size(), scene.mesh.face_of.size());
      EXPECT_GE(scene.mesh.triangles.size(), 1U);
      EXPECT_LE(scene.mesh.triangles.size(), 80U);
      EXPECT_FALSE(scene.cell.empty());
      for (const auto& p : scene.mesh.points) {
        for (const double x : p) EXPECT_TRUE(std::isfinite(x));
      }
    }
  }
}

TEST(DegenerateScenes, SliversAndDuplicatesOccur) {
  std::uint64_t without_area = 0, merged = 0;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    without_area += scene::degenerate_triangles(named("slivers").make(kSeed, i).mesh).size();
    for (const auto& piece : exact::build_complex(named("duplicates").make(kSeed, i).mesh).pieces)
      merged += piece.origins.size() > 1;
  }
  EXPECT_GT(without_area, 0U);
  EXPECT_GT(merged, 0U);
}

TEST(DegenerateScenes, TJunctionsAndCoplanarWallsAreCut) {
  for (const char* name : {"t_junctions", "coplanar_walls"}) {
    std::uint64_t cut = 0;
    for (std::uint64_t i = 0; i < kScenes; ++i)
      cut += exact::build_complex(named(name).make(kSeed, i).mesh).refined_triangles;
    EXPECT_GT(cut, 0U) << name;
  }
}

TEST(DegenerateScenes, FlatCellsHaveAllDimensions) {
  std::map<int, int> dimensions;
  for (std::uint64_t i = 0; i < kScenes; ++i)
    ++dimensions[exact::ConvexCell::from_doubles(named("flat_cells").make(kSeed, i).cell).dimension()];
  for (int d = 0; d <= 2; ++d) EXPECT_GT(dimensions[d], 0) << d;
}

// Seen from the cell's first vertex each long edge is in part before the others and in part behind the next blade.
TEST(DegenerateScenes, IrisesOverlapInACircle) {
  std::uint64_t circles = 0;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const GeneratedScene scene = named("irises").make(kSeed, i);
    const std::size_t blades = 3 + i % 4, triangles = i % 8 >= 4 ? 2 : 1;
    const auto corner = [&](std::size_t t, std::size_t k) {
      return exact::to_exact(scene.mesh.points[scene.mesh.triangles[t][k]]);
    };
    const exact::Point3 v = exact::to_exact(scene.cell.front());
    const auto is_hidden_by = [&](std::size_t blade, const exact::Point3& p) {
      const std::size_t t = blade * triangles;
      return CGAL::do_intersect(exact::Kernel::Segment_3(v, p),
                                exact::Kernel::Triangle_3(corner(t, 0), corner(t, 1), corner(t, 2)));
    };
    bool circle = true;
    for (std::size_t k = 0; k < blades; ++k) {
      const exact::Point3 a = corner(k * triangles, 0), b = corner(k * triangles, 1);
      bool hidden = false, seen = false;
      for (int part = 1; part < 16; ++part) {
        const exact::Point3 p = a + exact::FT(part) / 16 * (b - a);
        const bool behind_next = is_hidden_by((k + 1) % blades, p) || is_hidden_by((k + blades - 1) % blades, p);
        hidden |= behind_next;
        seen |= !behind_next;
      }
      circle &= hidden && seen;
    }
    circles += circle;
  }
  EXPECT_GT(circles, kScenes / 2);
}

TEST(DegenerateScenes, TouchingCellsTouch) {
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const GeneratedScene scene = named("touching_cells").make(kSeed, i);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    bool touches = false;
    for (const auto& p : scene.mesh.points) touches = touches || cell.contains(exact::to_exact(p));
    EXPECT_TRUE(touches) << i;
  }
}

}  // namespace
}  // namespace clues::fuzz
