// D17: what lies beyond a limit counts as visible. With lower limits both kernels list at least as much, and say that they gave up.
#include <gtest/gtest.h>

#include <algorithm>

#include "fastpath/visibility/map/local_map.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/first_order.h"

namespace clues {
namespace {

struct Scene {
  scene::TriangleMesh mesh;
  exact::ConvexCell cell;
};

struct Answer {
  std::vector<std::uint32_t> visible;
  std::uint64_t fallbacks = 0, csvs = 0;
};

Answer exact_answer(const Scene& s, const reference::Options& options) {
  const auto map = reference::first_order_visibility(s.mesh, s.cell, options);
  return {map.visible, map.statistics.conservative_fallbacks, map.statistics.csv};
}

Answer fast_answer(const Scene& s, const fastpath::LocalMapOptions& options) {
  const auto map = fastpath::make_local_map(s.mesh, s.cell, options);
  return {map.visible(), map.counts().conservative_fallbacks, map.counts().csv};
}

bool contains(const Answer& more, const Answer& less) {
  return std::includes(more.visible.begin(), more.visible.end(), less.visible.begin(), less.visible.end());
}

// mutations 3 of seed 20261122: a tetrahedral cap before the cell, and a triangle from its edge to a wall far behind. CSVs multiply with every generation.
Scene scene_of_many_csvs() {
  scene::TriangleMesh mesh;
  mesh.points = {{10.5, 0.5, 0.5}, {10, 0.5, -0.5}, {11, -0.5, -0.5},    {11, 0.5, -0.5},
                 {11, -0.5, 0.5},  {11, -0.5, 0.5}, {35.5, 1.75, -1.25}, {11, 0.5, 0.5},
                 {60, -3, -3},     {60, 3, -3},     {60, 3, 3},          {60, -3, 3}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {5, 7, 6}, {0, 2, 4},  {2, 5, 4},   {1, 6, 3}, {3, 6, 7},
                    {0, 4, 1}, {1, 4, 6}, {2, 3, 5}, {3, 7, 5}, {8, 9, 10}, {8, 10, 11}, {0, 1, 9}};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.face_of.push_back(t);
  std::vector<scene::Point> corners;
  for (const double x : {-5, 5}) {
    for (const double y : {-5, 5}) {
      for (const double z : {-5, 5}) corners.push_back({x, y, z});
    }
  }
  return {mesh, exact::ConvexCell::from_doubles(corners)};
}

TEST(Limits, ManyCsvsAreLeftOutAndCountAsVisible) {
  const Scene s = scene_of_many_csvs();
  fastpath::LocalMapOptions without_limit, low;
  without_limit.dials.csv_limit = 1000000;
  without_limit.dials.generation_limit = 16;
  low.dials.csv_limit = 0;
  const Answer all = fast_answer(s, without_limit), usual = fast_answer(s, {}), few = fast_answer(s, low);
  EXPECT_GT(all.csvs, 5000U);
  EXPECT_LT(usual.csvs, 2000U);
  EXPECT_LT(few.csvs, 200U);
  EXPECT_GT(usual.fallbacks, 0U);
  EXPECT_GT(few.fallbacks, 0U);
  EXPECT_TRUE(contains(usual, all));
  EXPECT_TRUE(contains(few, usual));
  reference::Options options;
  options.dials.csv_limit = 0;
  const Answer exact = exact_answer(s, options);
  EXPECT_LT(exact.csvs, 200U);
  EXPECT_GT(exact.fallbacks, 0U);
  EXPECT_TRUE(contains(exact, all));
}

TEST(Limits, EffortAllowsMoreCsvsAndEndsAMapThatTakesTooMuch) {
  const Scene s = scene_of_many_csvs();
  fastpath::LocalMapOptions low, by_effort;
  low.dials.csv_limit = by_effort.dials.csv_limit = 0;
  by_effort.csvs_by_effort = true;
  by_effort.effort = 1U << 30U;
  const Answer few = fast_answer(s, low), more = fast_answer(s, by_effort);
  EXPECT_GT(more.csvs, few.csvs);
  EXPECT_TRUE(contains(few, more));
  by_effort.effort = 10;
  EXPECT_THROW(fast_answer(s, by_effort), fastpath::EffortSpent);
}

TEST(Limits, WithoutWedgesOfCsvsNothingGetsLost) {
  std::uint64_t limited[2] = {0, 0};
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      const fuzz::GeneratedScene generated = fuzz::generate(kind, 20261121, i);
      SCOPED_TRACE(generated.name);
      const Scene s{generated.mesh, exact::ConvexCell::from_doubles(generated.cell)};
      reference::Options options;
      const Answer exact = exact_answer(s, options);
      options.dials.generation_limit = 0;
      const Answer exact_limited = exact_answer(s, options);
      EXPECT_TRUE(contains(exact_limited, exact));
      limited[0] += exact_limited.fallbacks;
      fastpath::LocalMapOptions fast;
      fast.dials.generation_limit = 0;
      const Answer fast_limited = fast_answer(s, fast);
      EXPECT_TRUE(contains(fast_limited, exact));
      limited[1] += fast_limited.fallbacks;
    }
  }
  EXPECT_GT(limited[0], 0U);
  EXPECT_GT(limited[1], 0U);
}

}  // namespace
}  // namespace clues
