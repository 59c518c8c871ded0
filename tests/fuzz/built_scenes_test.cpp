// The generators of built and of given scenes: pure, within their bounds, and degenerate in the way that they say, as far as the dial goes.
#include "fuzz/generators/built_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/campaign/given_files.h"
#include "fuzz/generators/parts.h"
#include "scene/files/atomic_file.h"
#include "scene/files/temporary_folder.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "tests/seed.h"

namespace clues::fuzz {
namespace {

constexpr std::uint64_t kScenes = 24;

const DegenerateGenerator& named(const std::string& name) {
  for (const auto& g : built_generators()) {
    if (g.name == name) return g;
  }
  throw std::runtime_error("no generator " + name);
}

void is_a_scene(const Case& scene, std::size_t most) {
  EXPECT_EQ(scene.mesh.triangles.size(), scene.mesh.face_of.size());
  EXPECT_GE(scene.mesh.triangles.size(), 1U);
  EXPECT_LE(scene.mesh.triangles.size(), most);
  EXPECT_FALSE(scene.cell.empty());
  for (const auto& t : scene.mesh.triangles) {
    for (const auto c : t) EXPECT_LT(c, scene.mesh.points.size());
  }
  for (const auto* points : {&scene.mesh.points, &scene.cell}) {
    for (const auto& p : *points) {
      for (const double x : p) EXPECT_TRUE(std::isfinite(x));
    }
  }
}

TEST(BuiltScenes, ArePureAndWithinBounds) {
  for (const auto& g : built_generators()) {
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      SCOPED_TRACE(std::string(g.name) + " " + std::to_string(i));
      const GeneratedScene scene = g.make(kSeed, i), again = g.make(kSeed, i);
      EXPECT_EQ(scene.mesh.points, again.mesh.points);
      EXPECT_EQ(scene.mesh.triangles, again.mesh.triangles);
      EXPECT_EQ(scene.cell, again.cell);
      is_a_scene({g.name, kSeed, i, scene.mesh, scene.cell, scene.solid}, 80);
      EXPECT_TRUE(scene::degenerate_triangles(scene.mesh).empty());
    }
  }
}

TEST(BuiltScenes, WhatIsMadeForSolidModeIsSolid) {
  for (const char* name : {"polytopes", "solids"}) {
    std::uint64_t solid = 0;
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      const GeneratedScene scene = named(name).make(kSeed, i);
      if (!scene.solid) continue;
      ++solid;
      EXPECT_TRUE(is_closed(scene.mesh)) << name << " " << i;
      EXPECT_TRUE(exact::triangles_not_solid(exact::build_complex(scene.mesh)).empty()) << name << " " << i;
    }
    EXPECT_GT(solid, kScenes / 4) << name;
  }
}

TEST(BuiltScenes, PolytopesAreConvexAndPointOutwards) {
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const GeneratedScene scene = named("polytopes").make(kSeed, i);
    if (!scene.solid || scene.mesh.triangles.size() > 2 * (4 + i % dials) - 4) continue;  // two of them
    const auto at = [&](std::uint32_t p) { return exact::to_exact(scene.mesh.points[p]); };
    for (const auto& [a, b, c] : scene.mesh.triangles) {
      for (std::uint32_t p = 0; p < scene.mesh.points.size(); ++p)
        EXPECT_NE(CGAL::orientation(at(a), at(b), at(c), at(p)), CGAL::POSITIVE);
    }
  }
}

// Dial 0 of the umbrellas is closed: each rim point is a corner of two triangles of the fan. Dial 1 differs by an ulp somewhere.
TEST(BuiltScenes, UmbrellasGapeAsTheDialSays) {
  for (std::uint64_t i = 0; i < 3; ++i) {
    std::uint64_t equal[dials];
    for (std::uint64_t dial = 0; dial < dials; ++dial) {
      const auto points = named("umbrellas").make(kSeed, dials * i + dial).mesh.points;
      equal[dial] = 0;
      const std::size_t fan = points.size() - 9;  // but for what is behind it
      for (std::size_t t = 0; t < fan; t += 3) equal[dial] += points[t + 2] == points[(t + 4) % fan];
      EXPECT_EQ(dial == 0, equal[dial] == fan / 3) << dial;
    }
  }
}

TEST(GivenScenes, AreReadFromFilesAndFoldersAndCutUp) {
  const scene::TemporaryFolder folder;
  GeneratedScene large;
  for (std::uint64_t i = 0; large.mesh.triangles.size() <= 40; ++i) large = named("city_blocks").make(kSeed, i);
  scene::write_file_atomically(folder.path() / "city.off", scene::to_off_text(large.mesh));
  const std::vector<std::string> paths{folder.path().string(), std::string(CLUES_SOURCE_DIR) + "/vectors/rooms.json"};
  const GivenScenes given = read_given_scenes(paths), again = read_given_scenes(paths);
  EXPECT_EQ(given.meshes.size(), 1U);
  EXPECT_GT(given.small.size(), 2U);
  EXPECT_EQ(given.hashes, again.hashes);
  EXPECT_EQ(given.hashes.size() % 64, 0U);
  std::uint64_t changed = 0;
  for (const auto& g : generators_named({"mutations", "mesh_pieces", "mutations:7"}, given)) {
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      SCOPED_TRACE(g.name + " " + std::to_string(i));
      const Case scene = g.make(kSeed, i);
      is_a_scene(scene, 80);
      EXPECT_EQ(scene.mesh.points, g.make(kSeed, i).mesh.points);
      EXPECT_EQ(scene.generator, g.name);
      EXPECT_EQ(scene.index, i);
      changed += std::none_of(given.small.begin(), given.small.end(), [&](const auto& s) {
        return s.mesh.points == scene.mesh.points && s.mesh.triangles == scene.mesh.triangles;
      });
    }
  }
  EXPECT_GT(changed, 2 * kScenes);
}

TEST(GivenScenes, WithoutAMeshNothingIsCutUp) {
  const GivenScenes none;
  for (const auto& g : generators_named({}, none)) EXPECT_NE(g.name, "mesh_pieces");
  EXPECT_THROW(generators_named({"mesh_pieces"}, none), scene::Error);
  EXPECT_THROW(generators_named({"umbrellas:8"}, none), scene::Error);
  EXPECT_THROW(generators_named({"umbrellas:"}, none), scene::Error);
  const scene::TemporaryFolder empty;
  EXPECT_THROW(read_given_scenes({empty.path().string()}), scene::Error);
  EXPECT_THROW(read_given_scenes({empty.file("none.off")}), scene::Error);
}

// A dial picks every eighth scene.
TEST(Dial, PicksEveryEighthScene) {
  const GivenScenes none;
  const auto all = generators_named({"forests"}, none).front(), one = generators_named({"forests:3"}, none).front();
  EXPECT_EQ(one.make(kSeed, 2).mesh.points, all.make(kSeed, 19).mesh.points);
}

}  // namespace
}  // namespace clues::fuzz
