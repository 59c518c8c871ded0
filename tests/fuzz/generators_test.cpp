// What the generators promise in their headers, checked exactly: sizes, purity, closedness, no contacts where none are meant.
#include <gtest/gtest.h>

#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random_scenes.h"
#include "tests/seed.h"

namespace clues::fuzz {
namespace {

TEST(RandomSceneGenerator, IsPureAndKeepsItsBounds) {
  for (const Kind kind : all_kinds) {
    for (std::uint64_t i = 0; i < 30; ++i) {
      const GeneratedScene scene = generate(kind, kSeed, i), again = generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      EXPECT_EQ(scene.mesh.points, again.mesh.points);
      EXPECT_EQ(scene.mesh.triangles, again.mesh.triangles);
      EXPECT_EQ(scene.cell, again.cell);
      EXPECT_GE(scene.mesh.triangles.size(), 4U);
      EXPECT_LE(scene.mesh.triangles.size(), 60U);
      for (const scene::Point& p : scene.mesh.points) {
        for (const double x : p) {
          EXPECT_EQ(x * 16, static_cast<double>(static_cast<int>(x * 16)));
          EXPECT_LE(x * x, 32.0 * 32.0);
        }
      }
    }
  }
}

TEST(RandomSceneGenerator, SolidsAreClosedAndDisjoint) {
  for (const Kind kind : {Kind::tetrahedra, Kind::nonconvex_solids}) {
    for (std::uint64_t i = 0; i < 12; ++i) {
      const GeneratedScene scene = generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const exact::Complex complex = exact::build_complex(scene.mesh);
      EXPECT_TRUE(complex.degenerate.empty());
      // Only a receiver wall, the last two triangles, may be open.
      for (const std::uint32_t t : exact::triangles_not_solid(complex)) EXPECT_GE(t + 2, scene.mesh.triangles.size());
      EXPECT_EQ(complex.refined_triangles, 0U);
    }
  }
}

TEST(RandomSceneGenerator, InterpenetratingScenesPierce) {
  std::uint64_t refined = 0;
  for (std::uint64_t i = 0; i < 6; ++i)
    refined += exact::build_complex(generate(Kind::interpenetrating, kSeed, i).mesh).refined_triangles;
  EXPECT_GT(refined, 0U);
}

TEST(CityGenerator, IsOneConformingSurface) {
  for (const std::uint32_t size : {26U, 300U, 1000U}) {
    const scene::TriangleMesh city = make_city(size, 3);
    if (size >= 200) {
      EXPECT_GE(city.triangles.size() * 10, size * 9);
      EXPECT_LE(city.triangles.size() * 10, size * 11);
    }
    const exact::Complex complex = exact::build_complex(city);
    EXPECT_TRUE(complex.degenerate.empty());
    EXPECT_EQ(complex.refined_triangles, 0U);  // a T-junction would be refined
    for (const exact::Edge& e : complex.edges) EXPECT_LE(e.pieces.size(), 2U);
  }
}

TEST(CityGenerator, TheStreetCellTouchesNothing) {
  for (const std::uint32_t size : {300U, 1000U}) {
    const exact::Complex complex = exact::build_complex(make_city(size, 1));
    const auto cell = exact::ConvexCell::from_doubles(street_cell(size, 1));
    EXPECT_EQ(cell.dimension(), 3);
    const exact::SceneQuery query(complex, cell);
    for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) EXPECT_FALSE(query.meets_cell(t));
  }
}

}  // namespace
}  // namespace clues::fuzz
