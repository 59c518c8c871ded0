// Maps of random scenes against three things that share no algorithm with them: the point-occlusion oracle (D18), exact sight lines (D5), and a
// second walk from other points of the cell (D14). No contradiction is tolerated. Every scene replays from its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "judges.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

// What must have occurred, or the run proved less than it says.
struct Occurred {
  reference::Statistics sum;
  std::uint64_t points = 0, sight_lines = 0;
  void add(const reference::Statistics& s) {
    sum.sv_me += s.sv_me;
    sum.se_me += s.se_me;
    sum.se_mv += s.se_mv;
    sum.csv += s.csv;
    sum.inside_corners += s.inside_corners;
    sum.generations = std::max(sum.generations, s.generations);
    sum.parallel_edges += s.parallel_edges;
    sum.refined_triangles += s.refined_triangles;
    sum.conservative_fallbacks += s.conservative_fallbacks;
    sum.regions_hidden += s.regions_hidden;
    sum.regions_visible += s.regions_visible;
  }
};

void judge_scenes(std::uint64_t per_kind, std::size_t points_per_region) {
  Occurred occurred;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      const auto map = map_of(scene.mesh, cell);
      const Contradictions c = contradictions(map, points_per_region, kSeed + i);
      EXPECT_EQ(c.seen_by_oracle, 0U);
      EXPECT_EQ(c.seen_by_sight_lines, 0U);
      EXPECT_EQ(map.statistics.walk_disagreements, 0U);
      EXPECT_EQ(c.invalid_witnesses, 0U);
      occurred.add(map.statistics);
      occurred.points += c.points;
      occurred.sight_lines += c.sight_lines;
    }
  }
  const reference::Statistics& s = occurred.sum;
  EXPECT_GT(s.sv_me, 0U);
  EXPECT_GT(s.se_me, 0U);
  EXPECT_GT(s.se_mv, 0U);
  EXPECT_GT(s.inside_corners, 0U);
  EXPECT_GT(s.csv, 0U);
  EXPECT_GE(s.generations, 2);
  EXPECT_GT(s.parallel_edges, 0U);
  EXPECT_GT(s.refined_triangles, 0U);
  EXPECT_GT(occurred.points, 0U);
  EXPECT_GT(occurred.sight_lines, 0U);
  std::cout << "seed " << kSeed << ", " << per_kind << " scenes of each kind: " << s.regions_visible << " visible and "
            << s.regions_hidden << " hidden regions, " << occurred.points << " hidden points by the oracle, "
            << occurred.sight_lines << " sight lines; SV-ME " << s.sv_me << ", SE-ME " << s.se_me << ", SE-MV "
            << s.se_mv << " (" << s.inside_corners << " at corners), CSVs " << s.csv << ", generations "
            << s.generations << ", parallel edges " << s.parallel_edges << ", refined triangles " << s.refined_triangles
            << ", fallbacks " << s.conservative_fallbacks << "\n";
}

TEST(RandomScenes, NothingHiddenIsSeen) { judge_scenes(6, 8); }

TEST(RandomScenesLong, NothingHiddenIsSeen) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_scenes(50, 20);
}

// A box with a mesh vertex on one of its faces, edges or corners, by turns.
std::vector<scene::Point> touching_box(const fuzz::GeneratedScene& scene, std::uint64_t seed) {
  fuzz::Random random(seed);
  const scene::Point q =
      scene.mesh.points[static_cast<std::size_t>(random.between(0, static_cast<int>(scene.mesh.points.size()) - 1))];
  const int shared = random.between(1, 3);  // coordinates in which q is on the border of the box
  scene::Point lo, hi;
  for (std::size_t i = 0; i < 3; ++i) {
    lo[i] = q[i] - random.between(1, 40) / 16.0;
    hi[i] = static_cast<int>(i) < shared ? q[i] : q[i] + random.between(1, 40) / 16.0;
  }
  std::vector<scene::Point> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]});
  return corners;
}

void judge_touching_cells(std::uint64_t per_kind, std::size_t points_per_region) {
  std::uint64_t points = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const auto map = map_of(scene.mesh, exact::ConvexCell::from_doubles(touching_box(scene, kSeed + i)));
      const Contradictions c = contradictions(map, points_per_region, kSeed + i);
      EXPECT_EQ(c.total(), 0U);
      EXPECT_EQ(map.statistics.walk_disagreements, 0U);
      points += c.points;
    }
  }
  EXPECT_GT(points, 0U);
}

TEST(RandomScenes, ACellThatTouchesAMeshVertex) { judge_touching_cells(3, 4); }

TEST(RandomScenesLong, ACellThatTouchesAMeshVertex) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_touching_cells(40, 6);
}

TEST(RandomScenes, TheMapDoesNotDependOnThreadsOrTriangleOrder) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, 1);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    reference::Options one, two;
    one.threads = 1;
    two.threads = 4;
    const scene::CellSpec spec{"", scene.cell};
    const auto first = reference::first_order_visibility(scene.mesh, cell, one);
    EXPECT_EQ(scene::to_json_text(reference::to_result(first, spec, true)),
              scene::to_json_text(
                  reference::to_result(reference::first_order_visibility(scene.mesh, cell, two), spec, true)));

    scene::TriangleMesh reversed = scene.mesh;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    const auto n = static_cast<std::uint32_t>(reversed.triangles.size());
    auto visible = reference::first_order_visibility(reversed, cell, one).visible;
    for (auto& t : visible) t = n - 1 - t;
    std::sort(visible.begin(), visible.end());
    EXPECT_EQ(visible, first.visible);
  }
}

}  // namespace
}  // namespace clues::test
