// D19: light on what a map calls hidden is found past blockers, without that map.
#include "validate/verdicts/light_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact/sight/witness.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::validate {
namespace {

// Three plates about a window, each under the next, and behind it triangle 3, which every kernel missed until parts of edges were kept from waiting in circles (T12).
scene::TriangleMesh iris() {
  scene::TriangleMesh mesh;
  mesh.points = {{-6, -1, 1}, {20, -1, -1},   {-45, -40, 1}, {1, -5, 1}, {1, 21, -1}, {40, -5, 1},
                 {5, 6, 1},   {-21, -20, -1}, {5, 45, 1},    {8, 4, -3}, {1, 0, -3},  {0, 0, -3}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  mesh.face_of = {0, 1, 2, 3};
  return mesh;
}

const std::vector<std::vector<scene::Point>> iris_cells{
    {{0, 0, 20}},
    {{-1, 0, 20}, {1, 0, 20}},
    {{-1, -1, 20}, {1, -1, 20}, {-1, 1, 20}, {1, 1, 20}},
    {{-1, -1, 20}, {1, -1, 20}, {-1, 1, 20}, {1, 1, 20}, {-1, -1, 21}, {1, -1, 21}, {-1, 1, 21}, {1, 1, 21}}};

TEST(LightSearch, LooksThroughTheWindowOfAnIris) {
  const auto mesh = iris();
  for (const auto& points : iris_cells) {
    SCOPED_TRACE(points.size());
    const auto cell = exact::ConvexCell::from_doubles(points);
    const LightSearch search(mesh, cell, true);
    const auto found = search.find(3), again = search.find(3);
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(exact::check_witness(mesh, cell, 3, found->front, found->v, found->p).valid);
    EXPECT_EQ(found->v, again->v);
    EXPECT_EQ(found->p, again->p);
  }
}

TEST(LightSearch, WorksInEveryUnit) {
  for (const double unit : {0x1p-200, 0x1p-30, 0x1p30, 0x1p200, 0x1p1018}) {
    auto mesh = iris();
    auto points = iris_cells.back();
    for (auto* list : {&mesh.points, &points}) {
      for (auto& p : *list) {
        for (double& x : p) x *= unit;
      }
    }
    EXPECT_TRUE(LightSearch(mesh, exact::ConvexCell::from_doubles(points), true).find(3).has_value()) << unit;
  }
}

// A blocker with a corner in the triangle's plane has a shadow with a side of no length. On both sides of that lay all that was left, twice as much with each such side: `clues check`
// of these four triangles ran out of 24 GiB. (Found by a campaign: ulp_perturbed, seed 20261125, scene 196.)
TEST(LightSearch, EndsWhereAShadowHasASideWithoutLength) {
  scene::TriangleMesh mesh;
  mesh.points = {{2.8125, 1.1875, 4}, {0, 1.1875, 4}, {0, 1.1875, 6.8125},
                 {2.8125, 0, 4},      {0, 0, 6.8125}, {0, 0, 3.9999999999999996}};
  mesh.triangles = {{3, 4, 5}, {5, 4, 2}, {5, 2, 1}, {3, 1, 0}};
  mesh.face_of = {0, 1, 2, 3};
  const auto cell = exact::ConvexCell::from_doubles({{-3.5625, -3, 4.249999999999999},
                                                     {-1.25, -3, 4.25},
                                                     {-3.5625, 1.1875, 4.25},
                                                     {-1.25, 1.1875, 4.25},
                                                     {-3.5625, -3, 5.5},
                                                     {-1.25, -3, 5.5},
                                                     {-3.5625, 1.1875, 5.5},
                                                     {-1.25, 1.1875, 5.5}});
  const LightSearch search(mesh, cell, true);
  for (std::uint32_t t = 0; t < 4; ++t) {
    const auto found = search.find(t);
    EXPECT_TRUE(!found || exact::check_witness(mesh, cell, t, found->front, found->v, found->p).valid);
  }
}

// Vertices that no triangle has are no part of the scene.
TEST(LightSearch, DoesNotMindVerticesWithoutATriangle) {
  auto mesh = iris();
  mesh.points.push_back({0x1p1000, 0, 0});
  EXPECT_TRUE(LightSearch(mesh, exact::ConvexCell::from_doubles(iris_cells.back()), true).find(3).has_value());
}

// The side that is seen of triangle 3 is its back.
TEST(LightSearch, LeavesBacksOutWhereTheyDoNotCount) {
  auto mesh = iris();
  const auto cell = exact::ConvexCell::from_doubles(iris_cells.back());
  const bool front = LightSearch(mesh, cell, true).find(3)->front;
  if (front) std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_FALSE(LightSearch(mesh, cell, false).find(3).has_value());
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_TRUE(LightSearch(mesh, cell, false).find(3).has_value());
}

// Both copies of a triangle are seen: neither hides the other.
TEST(LightSearch, WhatLiesInThePlaneHidesNothing) {
  auto mesh = iris();
  mesh.triangles.push_back(mesh.triangles[3]);
  mesh.face_of.push_back(4);
  const auto cell = exact::ConvexCell::from_doubles(iris_cells.back());
  const LightSearch search(mesh, cell, true);
  EXPECT_TRUE(search.find(3).has_value());
  EXPECT_TRUE(search.find(4).has_value());
}

TEST(LightSearch, FindsMostOfWhatIsVisibleAndNothingThatIsHidden) {
  std::uint64_t visible = 0, found = 0, hidden = 0;
  for (const auto kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      const auto scene = fuzz::generate(kind, 7, i);
      const auto cell = exact::ConvexCell::from_doubles(scene.cell);
      const auto map = reference::first_order_visibility(scene.mesh, cell, {});
      const LightSearch search(scene.mesh, cell, true);
      for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
        const bool listed = std::binary_search(map.visible.begin(), map.visible.end(), t),
                   seen = search.find(t).has_value();
        EXPECT_TRUE(listed || !seen) << scene.name << ' ' << t;
        visible += listed;
        found += listed && seen;
        hidden += !listed;
      }
    }
  }
  EXPECT_GT(10 * found, 9 * visible);
  EXPECT_GT(hidden, 30U);
}

// As the reference once had it: of triangle 3 there is one region, a dark one, and in it a place that is dark.
TEST(Judge, WhatAMapForgotBehindAWindowIsAContradiction) {
  const auto mesh = iris();
  const auto cell = exact::ConvexCell::from_doubles(iris_cells.back());
  auto map = reference::first_order_visibility(mesh, cell, {});
  ASSERT_EQ(map.visible.size(), 4U);
  map.visible.pop_back();
  std::erase_if(map.regions, [&](const reference::Region& r) {
    return map.complex.pieces[r.piece].origins.front().triangle == 3 && r.visible;
  });
  const auto judgement = judge_pvs(mesh, map, {0, 1, 2});
  EXPECT_EQ(judgement.verdict, Verdict::unsound);
  ASSERT_EQ(judgement.contradictions.size(), 1U);
  EXPECT_EQ(judgement.contradictions[0].triangle, 3U);
  JudgeOptions unchecked;
  unchecked.cross_check = false;
  EXPECT_EQ(judge_pvs(mesh, map, {0, 1, 2}, unchecked).verdict, Verdict::sound);
}

}  // namespace
}  // namespace clues::validate
