// The fast path makes the file of the reference, byte for byte, with any number of threads; and a mistake of it would show.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/dials.h"
#include "fastpath/multires/build.h"
#include "fastpath/multires/surface_star.h"
#include "fuzz/generators/random.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/hierarchy.h"
#include "reference/multires/stars/features.h"
#include "reference/multires/stars/hole.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy_file.h"
#include "tests/seed.h"
#include "validate/multires/lint_multires.h"

namespace clues {
namespace {

namespace fast = fastpath::multires;

struct Question {
  scene::TriangleMesh mesh;
  std::uint64_t base = 0;
  std::vector<scene::Edge> features;
  std::vector<std::uint32_t> fixed;
};

std::string by_reference(const Question& q) {
  reference::HierarchyOptions options;
  options.base_triangles = q.base;
  options.features = q.features;
  options.fixed = q.fixed;
  return scene::to_text(reference::build_hierarchy(q.mesh, options));
}
std::string by_doubles(const Question& q, int threads = 1, fast::BuildCounts* counts = nullptr) {
  fast::BuildOptions options;
  options.base_triangles = q.base;
  options.features = q.features;
  options.fixed = q.fixed;
  options.threads = threads;
  return scene::to_text(fast::build_hierarchy(q.mesh, options, "mesh", counts));
}

void expect_same(const Question& q, const std::string& name) {
  const std::string expected = by_reference(q);
  const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);  // on machines of two cores, too
  for (int threads = 1; threads <= 3; ++threads) {
    // Not EXPECT_EQ: nobody reads two files of a megabyte.
    ASSERT_TRUE(by_doubles(q, threads) == expected) << name << ", " << threads << " threads";
  }
}

TEST(FastHierarchy, OfKnownShapesIsTheReferences) {
  for (int n = 1; n <= 12; ++n) expect_same({fuzz::ball(n), 0, {}, {}}, "ball");
  for (int genus = 0; genus < 4; ++genus) expect_same({fuzz::frame(genus, 3), 60, {}, {}}, "frame");
  for (const int n : {1, 2, 5, 20}) expect_same({fuzz::sheet(n), 0, {}, {}}, "sheet");
  expect_same({fuzz::ball(30), 200, {}, {}}, "a large ball");
}

// The vertex in the middle is removed with 11 neighbours, and stays with 12.
TEST(FastHierarchy, OfHighStarsIsTheReferences) {
  for (int n = 3; n < 16; ++n) {
    expect_same({fuzz::fan(n, true), 0, {}, {}}, "closed fan");
    expect_same({fuzz::fan(n, false), 0, {}, {}}, "open fan");
  }
}

TEST(FastHierarchy, OfASurfaceInOnePointOrOfAnySizeIsTheReferences) {
  for (const double factor : {0x1p1000, 0x1p-900, 0.0}) {
    auto mesh = fuzz::ball(6);
    for (auto& p : mesh.points) {
      for (double& x : p) x *= factor;
    }
    expect_same({mesh, 20, {}, {}}, "scaled");
  }
}

TEST(FastHierarchy, WithFeaturesIsTheReferences) {
  const auto mesh = fuzz::frame(2, 4);
  const auto sharp = reference::sharp_edges(mesh, 0.5);
  EXPECT_GT(sharp.size(), 100U);
  expect_same({mesh, 0, sharp, {}}, "all features");
  auto half = sharp;  // ends, and edges given twice and the wrong way round
  half.resize(sharp.size() / 2);
  half.push_back({sharp[0][1], sharp[0][0]});
  expect_same({mesh, 0, half, {3, 7, 7}}, "some features");
  const auto sheet = fuzz::sheet(6);
  std::vector<scene::Edge> rim;  // features along the boundary are none, and those that end there fix the end
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    rim.push_back(scene::edge_of(sheet.triangles[t][0], sheet.triangles[t][1]));
  }
  rim.resize(8);
  expect_same({sheet, 0, rim, {}}, "features on a boundary");
}

TEST(FastHierarchy, OfTheSuiteIsTheReferences) {
  std::size_t surfaces = 0, refused = 0;
  for (const auto& path : validate::side_vector_files(CLUES_SOURCE_DIR "/vectors/multires")) {
    for (const auto& test : validate::read_multires_topic(path).cases) {
      Question q{test.mesh, 0, test.features, test.fixed};
      if (test.kind != validate::MultiresKind::surface) {
        if (test.text.empty()) continue;
        q.mesh = scene::parse_hierarchy(test.text, test.id).input;
      }
      if (test.refused) {
        EXPECT_THROW(by_doubles(q), scene::Error) << test.id;
        ++refused;
        continue;
      }
      try {
        reference::checked_surface(q.mesh, test.id);
      } catch (const scene::Error&) {
        EXPECT_THROW(by_doubles(q), scene::Error) << test.id;
        continue;
      }
      expect_same(q, test.id);
      ++surfaces;
    }
  }
  EXPECT_GT(surfaces, 20U);
  EXPECT_GT(refused, 5U);
}

// Shaken, folded, with slivers, with many vertices in one place; of genus 0 to 3, with up to 4 boundaries.
void random_surfaces(std::uint64_t seed, std::uint64_t count) {
  const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);
  fast::BuildCounts counts;
  std::uint64_t features = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    Question q{fuzz::surface_case(seed, k).mesh, k % 7, {}, {}};
    if (k % 3 == 0) q.features = reference::sharp_edges(q.mesh, 0.5);
    features += q.features.size();
    ASSERT_TRUE(by_doubles(q, static_cast<int>(k % 3) + 1, &counts) == by_reference(q))
        << "seed " << seed << ", case " << k;
  }
  EXPECT_GT(features, count);
  EXPECT_GT(counts.covered_again, count / 10);  // or what is done beforehand would not be tested
  EXPECT_GT(counts.levels_again, count / 20);
}
TEST(FastHierarchy, OfRandomSurfacesIsTheReferences) { random_surfaces(kSeed, 300); }
TEST(FastHierarchyLong, OfRandomSurfacesIsTheReferences) { random_surfaces(kSeed + 2, 10'000); }

// Where the overlay forbids nothing, levels, base domain and images of vertices are the same without it.
TEST(FastHierarchy, WithoutOverlayHasTheSameImages) {
  std::uint64_t compared = 0;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const auto mesh = fuzz::surface_case(kSeed, k).mesh;
    fast::BuildOptions options;
    options.base_triangles = 20;
    fast::BuildCounts counts;
    auto with = fast::build_hierarchy(mesh, options, "mesh", &counts);
    if (counts.levels_again > 0 || with.levels.size() < 2) continue;
    ++compared;
    with.points.resize(mesh.points.size());
    with.pieces.clear();
    options.overlay = false;
    for (options.threads = 1; options.threads <= 2; ++options.threads) {
      ASSERT_TRUE(scene::to_text(with) == scene::to_text(fast::build_hierarchy(mesh, options))) << k;
    }
  }
  EXPECT_GT(compared, 10U);
}

// Every filter says that it does not know: whole numbers make the same file.
TEST(FastHierarchy, WithoutDoublesIsTheSame) {
  exact::ProcessDials dials;
  dials.unsure_doubles = true;
  for (std::uint64_t k = 0; k < 30; ++k) {
    const Question q{fuzz::surface_case(kSeed, k).mesh, k % 7, {}, {}};
    const std::string expected = by_doubles(q);
    const exact::TurnedProcessDials turned(dials);
    ASSERT_TRUE(by_doubles(q) == expected) << k;
  }
}

TEST(FastHierarchy, IsRefusedWhereThereIsNone) {
  const auto fails = [](const scene::TriangleMesh& mesh) {
    fast::BuildOptions options;
    EXPECT_THROW(fast::build_hierarchy(mesh, options), scene::Error);
  };
  fails(fuzz::moebius(5));
  auto mesh = fuzz::sheet(2);
  mesh.points.push_back({5, 5, 5});
  fails(mesh);  // a vertex without triangle
  mesh = fuzz::sheet(2);
  mesh.triangles.push_back(mesh.triangles[0]);
  fails(mesh);
  mesh = fuzz::sheet(2);
  mesh.triangles[0][1] = mesh.triangles[0][0];
  fails(mesh);
  mesh = fuzz::fan(1, false);
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][2], mesh.triangles[0][1]});
  fails(mesh);  // two triangles of the same vertices, a closed surface but for that
  mesh = fuzz::fan(1, false);
  mesh.points.push_back({2, 0, 0});
  mesh.points.push_back({0, 2, 0});
  mesh.triangles.push_back({mesh.triangles[0][0], 3, 4});
  fails(mesh);  // two fans at one vertex
  mesh = fuzz::sheet(3);
  const auto options_fail = [&](auto change) {
    fast::BuildOptions options;
    change(options);
    EXPECT_THROW(fast::build_hierarchy(mesh, options), scene::Error);
  };
  options_fail([](auto& o) { o.features = {{0, 15}}; });
  options_fail([](auto& o) { o.features = {{0, 99}}; });
  options_fail([](auto& o) { o.fixed = {16}; });
}

// Holes in rings that lie on a circle, exactly or rounded, some corners joined beforehand: covers against the reference's.
TEST(FastHole, OfCocircularRingsIsTheReferences) {
  constexpr std::array<std::array<std::int64_t, 2>, 12> on_circle{{{63, 16},
                                                                   {52, 39},
                                                                   {39, 52},
                                                                   {16, 63},
                                                                   {-16, 63},
                                                                   {-39, 52},
                                                                   {-52, 39},
                                                                   {-63, 16},
                                                                   {-56, -33},
                                                                   {-25, -60},
                                                                   {25, -60},
                                                                   {56, -33}}};
  fuzz::Random random(9);
  int covered = 0, refused = 0;
  for (int k = 0; k < 5000; ++k) {
    fast::SurfaceStar star;
    fast::DiskLayout layout;
    reference::HolePolygon polygon;
    const bool rounded = random.one_in(3);
    std::vector<std::uint32_t> numbers(12);
    for (std::uint32_t i = 0; i < 12; ++i) numbers[i] = i;
    for (std::size_t i = 12; i-- > 1;)
      std::swap(numbers[i], numbers[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
    const auto skipped = static_cast<std::size_t>(random.between(0, 11));
    for (std::size_t i = 0; i < 12; ++i) {
      if (i == skipped || (!random.one_in(4) ? false : star.size + (12 - i) > 5)) continue;
      exact::DiskPoint p{on_circle[i][0] * 200000, on_circle[i][1] * 200000};
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 12;
      if (rounded) p = {std::llround(0x1p24 * std::cos(angle)), std::llround(0x1p24 * std::sin(angle))};
      layout.ring_[star.size] = p;
      star.ring_[star.size++] = numbers[i];
      polygon.points.push_back(p);
      polygon.vertices.push_back(numbers[i]);
    }
    star.sectors = star.size;
    star.vertex = 99;
    fast::RingEdges joined{};
    for (int edges = random.between(0, 12); edges > 0; --edges) {
      const auto a = static_cast<std::size_t>(random.between(0, static_cast<int>(star.size) - 1)),
                 b = static_cast<std::size_t>(random.between(0, static_cast<int>(star.size) - 1));
      const std::size_t apart = a < b ? b - a : a - b;
      if (apart < 2 || apart + 1 == star.size) continue;
      joined[a] = static_cast<std::uint16_t>(joined[a] | (1U << b));
      joined[b] = static_cast<std::uint16_t>(joined[b] | (1U << a));
    }
    const auto forbidden = [&](std::uint32_t v, std::uint32_t w) {
      const auto place = [&](std::uint32_t x) {
        return static_cast<std::size_t>(std::find(star.ring_.begin(), star.ring_.end(), x) - star.ring_.begin());
      };
      return (joined[place(v)] >> place(w) & 1U) != 0;
    };
    const auto expected = reference::triangulated(polygon, forbidden);
    fast::HoleCover cover;
    const bool sure = !random.one_in(4);
    ASSERT_EQ(fast::cover_hole(star, layout, joined, sure, cover), expected.has_value()) << k;
    ++(expected ? covered : refused);
    if (!expected) continue;
    const auto triangles = cover.triangles();
    ASSERT_TRUE(std::equal(triangles.begin(), triangles.end(), expected->begin(), expected->end())) << k;
  }
  EXPECT_GT(covered, 3000);
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace clues
