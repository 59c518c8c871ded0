// The traversal gives the map of the plain formulation, region by region; order and seeds do not matter; what is hidden costs no wedge.
#include "reference/visibility/traversal/traversal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "fuzz/generators/city.h"
#include "fuzz/generators/random_scenes.h"
#include "judges.h"
#include "reference/visibility/map/regions.h"
#include "same_map.h"
#include "support.h"
#include "validate/vectors/reader.h"

namespace clues::test {
namespace {

using reference::Formulation;
using reference::Options;
using reference::VisibilityMap;

VisibilityMap map_by(Formulation formulation, const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  Options options;
  options.formulation = formulation;
  options.check_two_walks = false;
  return reference::first_order_visibility(mesh, cell, options);
}

struct Totals {
  std::uint64_t scenes = 0, pieces = 0, visited = 0, seen = 0, passes = 0, by_order = 0, cycles = 0, clusters = 0;
  void add(const VisibilityMap& map) {
    ++scenes;
    pieces += map.complex.pieces.size();
    visited += map.statistics.surfaces_visited;
    seen += map.statistics.surfaces_seen;
    passes += map.statistics.passes;
    by_order += map.statistics.by_order;
    cycles += map.statistics.cycles;
    clusters += map.statistics.clusters;
  }
  void print() const {
    std::cout << scenes << " scenes, " << pieces << " pieces, " << visited << " visited, " << seen << " seen, "
              << passes << " passes, " << by_order << " by order, " << cycles << " cycles, " << clusters
              << " clusters\n";
  }
};

void expect_same(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, Totals& totals) {
  const auto plain = map_by(Formulation::plain, mesh, cell), traversal = map_by(Formulation::traversal, mesh, cell);
  EXPECT_EQ(plain.visible, traversal.visible);
  EXPECT_EQ(region_lines(plain), region_lines(traversal));
  EXPECT_EQ(segment_lines(plain), segment_lines(traversal));
  totals.add(traversal);
}

void same_on_random_scenes(std::uint64_t per_kind, std::uint64_t seed) {
  Totals totals;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const auto scene = fuzz::generate(kind, seed, i);
      SCOPED_TRACE(scene.name);
      expect_same(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), totals);
    }
  }
  totals.print();
}

void same_on_suite(std::size_t stride) {
  Totals totals;
  const auto cases = validate::read_suite(std::filesystem::path(CLUES_SOURCE_DIR) / "vectors");
  ASSERT_FALSE(cases.empty());
  for (std::size_t i = 0; i < cases.size(); i += stride) {
    SCOPED_TRACE(cases[i].id);
    expect_same(cases[i].mesh, exact::ConvexCell::from_doubles(cases[i].cell), totals);
  }
  totals.print();
}

TEST(Traversal, RandomScenesHaveTheSameMap) {
  for (const std::uint64_t seed : {1U, 2U}) same_on_random_scenes(2, seed);
}

TEST(TraversalLong, RandomScenesHaveTheSameMap) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  same_on_random_scenes(50, 20261121);
  for (const std::uint64_t seed : {3U, 4U, 5U}) same_on_random_scenes(10, seed);
}

TEST(Traversal, EveryTwelfthCaseOfTheSuiteHasTheSameMap) { same_on_suite(12); }

TEST(TraversalLong, TheSuiteHasTheSameMap) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  same_on_suite(1);
}

TEST(Traversal, ACityHasTheSameMap) {
  Totals totals;
  expect_same(fuzz::make_city(300, 1), exact::ConvexCell::from_doubles(fuzz::street_cell(300, 1)), totals);
  EXPECT_LT(totals.visited, totals.pieces / 2);
}

// The wedges and the map when the traversal starts at these pieces.
VisibilityMap map_from_seeds(const exact::SceneQuery& whole, const std::vector<std::uint32_t>& seeds) {
  VisibilityMap map{whole.complex(), whole.cell(), reference::Mode::sheet, Formulation::traversal, {}, {}, {}, {}, {}};
  const Options options;
  const auto t = reference::traverse(whole, options, map.statistics, seeds);
  for (const auto& p : t.fixpoint.wedges.pieces()) map.wedges.push_back(p.wedge);
  reference::make_regions(*t.scene, t.fixpoint, {t.visited, {}}, options, map);
  return map;
}

TEST(Traversal, SeedsAndTriangleOrderDoNotMatter) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    const auto scene = fuzz::generate(kind, 6, 0);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const auto plain = map_by(Formulation::plain, scene.mesh, cell);
    const exact::SceneQuery whole(plain.complex, cell);
    const auto n = static_cast<std::uint32_t>(plain.complex.pieces.size());
    for (const std::uint32_t seed : {0U, n / 3, n / 2, n - 1}) {
      const auto map = map_from_seeds(whole, {seed});
      EXPECT_EQ(region_lines(map), region_lines(plain));
      EXPECT_EQ(wedge_lines(map.wedges), wedge_lines(plain.wedges));
    }
    scene::TriangleMesh reversed = scene.mesh;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    const auto m = static_cast<std::uint32_t>(reversed.triangles.size());
    auto visible = map_by(Formulation::traversal, reversed, cell).visible;
    for (auto& t : visible) t = m - 1 - t;
    std::sort(visible.begin(), visible.end());
    EXPECT_EQ(visible, plain.visible);
  }
}

// Boxes behind a wall, row after row. Twice as deep, six times over: the same surfaces visited, the same wedges built.
TEST(Traversal, HiddenDepthBuildsNoWedge) {
  const auto cell = box_cell(-1, -1, -1, 1, 1, 0);
  reference::Statistics first;
  std::uint64_t plain_walks = 0;
  for (const int rows : {1, 2, 4, 8, 16, 32, 64}) {
    SceneBuilder s;
    s.plate(-40, -40, 40, 40, 4);
    s.box({-3, -3, 2}, {-2, -2, 3});
    for (int i = 0; i < rows; ++i) {
      for (const double x : {-2.0, 1.0}) s.box({x, x / 2, 6.0 + 2 * i}, {x + 1, x / 2 + 1, 7.0 + 2 * i});
    }
    s.plate(-90, -90, 90, 90, 6.0 + 2 * 64);
    const auto map = map_by(Formulation::traversal, s.mesh(), cell);
    const auto& now = map.statistics;
    if (rows == 1) {
      first = now;
      plain_walks = map_by(Formulation::plain, s.mesh(), cell).statistics.walks;
    }
    EXPECT_EQ(now.wedges_built, first.wedges_built) << rows;
    EXPECT_EQ(now.surfaces_visited, first.surfaces_visited) << rows;
    EXPECT_EQ(now.sight_lines, first.sight_lines) << rows;
    EXPECT_EQ(now.passes, first.passes) << rows;
    EXPECT_LE(now.shaft_tests, first.shaft_tests + 64) << rows;
    if (rows == 64) {
      const auto plain = map_by(Formulation::plain, s.mesh(), cell);
      EXPECT_GT(plain.statistics.walks, 4 * plain_walks);  // what the plain formulation pays
      EXPECT_EQ(plain.visible, map.visible);
    }
  }
}

// It stands in lit space behind a wall's edge, alone; no wedge touches it, no sight line of the first look meets it.
TEST(Traversal, WhatStandsFreeInLitSpaceIsFound) {
  SceneBuilder s;
  s.plate(-1, -1, 1, 1, 2);
  const std::uint32_t small = s.triangle({30, 3, 8}, {30.25, 3, 8}, {30, 3.25, 8});
  const auto map = map_by(Formulation::traversal, s.mesh(), box_cell(-0.25, -0.25, 0, 0.25, 0.25, 0.25));
  EXPECT_TRUE(std::binary_search(map.visible.begin(), map.visible.end(), small));
  EXPECT_GT(map.statistics.passes, 1U);
}

TEST(Traversal, NothingAtAllAndNothingInSight) {
  const auto cell = box_cell(0, 0, 0, 1, 1, 1);
  EXPECT_TRUE(map_by(Formulation::traversal, scene::TriangleMesh{}, cell).visible.empty());
  SceneBuilder s;  // inside a closed box that the cell is in as well: seen from all around
  s.box({-2, -2, -2}, {3, 3, 3});
  s.box({10, 10, 10}, {11, 11, 11});
  const auto map = map_by(Formulation::traversal, s.mesh(), cell);
  EXPECT_EQ(map.visible.size(), 12U);
  EXPECT_EQ(map.statistics.surfaces_visited, 12U);
}

}  // namespace
}  // namespace clues::test
