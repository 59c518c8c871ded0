// T6: the map of a cell in what a cell around it sees is its map in the whole scene, region for region: in the suite, with parts of each cell, and in random scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "fastpath/visibility/first_order.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/flagged_mesh.h"
#include "validate/vectors/reader.h"
#include "validate/verdicts/measures.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;
using Points = std::vector<scene::Point>;

// What a run has time for.
struct Most {
  std::size_t parts, triangles;
};

// Half the cell, towards each of its points. All of it is in the cell, or it is not taken.
std::vector<Points> parts_of(const Points& cell, std::size_t most) {
  const auto whole = exact::ConvexCell::from_doubles(cell);
  std::vector<Points> parts;
  for (std::size_t i = 0; i < std::min(cell.size(), most); ++i) {
    Points part;
    for (const auto& p : cell)
      part.push_back({p[0] / 2 + cell[i][0] / 2, p[1] / 2 + cell[i][1] / 2, p[2] / 2 + cell[i][2] / 2});
    const bool within = std::all_of(part.begin(), part.end(), [&](const scene::Point& p) {
      return whole.contains({p[0], p[1], p[2]});
    });
    if (within && exact::ConvexCell::from_doubles(part).dimension() == whole.dimension()) parts.push_back(part);
  }
  return parts;
}

struct Count {
  std::uint64_t parts = 0, smaller_scenes = 0, with_fallbacks = 0, cut_regions = 0;
};

void compare(const scene::TriangleMesh& mesh, const Points& cell, const Most& most, Count& count) {
  if (mesh.triangles.size() > most.triangles) return;
  const auto around = reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {});
  if (around.visible.empty()) return;
  const auto part_mesh = scene::part_of(mesh, around.visible);
  for (const auto& part : parts_of(cell, most.parts)) {
    const auto v = exact::ConvexCell::from_doubles(part);
    const auto whole = reference::first_order_visibility(mesh, v, {});
    const auto within = reference::first_order_visibility(part_mesh, v, {});
    ++count.parts;
    if (part_mesh.triangles.size() < mesh.triangles.size()) ++count.smaller_scenes;
    Ids listed;
    for (const auto t : within.visible) listed.push_back(around.visible[t]);
    EXPECT_TRUE(
        std::includes(around.visible.begin(), around.visible.end(), whole.visible.begin(), whole.visible.end()));
    if (whole.statistics.conservative_fallbacks + within.statistics.conservative_fallbacks > 0) {
      ++count.with_fallbacks;
      continue;
    }
    EXPECT_EQ(listed, whole.visible);
    const auto a = validate::first_order_fractions(mesh, whole), b = validate::first_order_fractions(part_mesh, within);
    for (std::size_t i = 0; i < around.visible.size(); ++i) {
      EXPECT_EQ(a[around.visible[i]], b[i]) << "triangle " << around.visible[i];
      if (a[around.visible[i]][0] > 0 && a[around.visible[i]][0] < 1) ++count.cut_regions;
    }
    // The fast path, by lists.
    const auto list = [&](const scene::TriangleMesh& scene) {
      return fastpath::first_order_visibility(fastpath::Bvh(scene), part, fastpath::LocalMapOptions{});
    };
    const auto fast = list(mesh), fast_within = list(part_mesh);
    if (fast.conservative_fallbacks + fast_within.conservative_fallbacks > 0) continue;
    Ids fast_listed;
    for (const auto t : fast_within.visible) fast_listed.push_back(around.visible[t]);
    EXPECT_EQ(fast_listed, fast.visible);
  }
}

void print(const Count& count) {
  std::cout << count.parts << " parts of cells, " << count.smaller_scenes << " in a smaller scene, "
            << count.cut_regions << " sides seen in part, " << count.with_fallbacks << " with fallbacks\n";
}

void compare_suite(const Most& most) {
  Count count;
  for (const auto& c : validate::read_suite(std::string(CLUES_SOURCE_DIR) + "/vectors")) {
    if (c.mode != validate::CaseMode::sheet) continue;
    SCOPED_TRACE(c.id);
    compare(c.mesh, c.cell, most, count);
  }
  print(count);
  EXPECT_GT(count.smaller_scenes, 20U);
  EXPECT_GT(count.cut_regions, 20U);
}

void compare_random(std::uint64_t from, std::uint64_t scenes, const Most& most) {
  Count count;
  for (std::uint64_t n = from; n < from + scenes; ++n) {
    SCOPED_TRACE(n);
    const auto kind = fuzz::all_kinds[n % fuzz::all_kinds.size()];
    const auto c = fuzz::generate(kind, 20261123, n);
    compare(c.mesh, c.cell, most, count);
  }
  print(count);
  EXPECT_GT(count.smaller_scenes, 0U);
}

TEST(Hierarchy, PartsOfCellsOfTheSuite) { compare_suite({1, 8}); }
TEST(HierarchyLong, PartsOfCellsOfTheSuite) { compare_suite({8, 1000}); }
TEST(Hierarchy, PartsOfCellsInRandomScenes) { compare_random(0, 24, {1, 10}); }
TEST(HierarchyLong, PartsOfCellsInRandomScenes) { compare_random(24, 300, {8, 1000}); }

}  // namespace
}  // namespace clues::tests
