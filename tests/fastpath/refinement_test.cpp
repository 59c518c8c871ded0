// Refined maps of the fast path against what shares no algorithm with them: the exact visible set, the point-occlusion oracle, and for the scenes with numbers in the
// hazard list those numbers. tests/differential compares them with the reference's.
#include "fastpath/visibility/refinement/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/complex/complex.h"
#include "fastpath/visibility/refinement/adjusted_cut.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "refinement_judges.h"
#include "tests/seed.h"
#include "validate/visible_set/visible_set.h"

namespace clues::fastpath {
namespace {

Ids exactly_visible(const scene::TriangleMesh& mesh, const std::vector<Point>& cell) {
  const auto set = validate::exact_visible_set(mesh, exact::ConvexCell::from_doubles(cell));
  Ids ids;
  for (std::uint32_t t = 0; t < set.triangles.size(); ++t) {
    if (set.triangles[t].sight == validate::Sight::visible) ids.push_back(t);
  }
  return ids;
}

// --- soundness --------------------------------------------------------------------------------------------------------------

void judge(const scene::TriangleMesh& mesh, const std::vector<Point>& cell, RefinementOptions options,
           std::size_t points, Judged& judged) {
  const Ids visible = exactly_visible(mesh, cell);
  options.regions = false;
  // Without sight lines every visible triangle has to be found again in the maps of the parts.
  options.sight_lines = 0;
  judged.missing += missing_from(visible, refine(mesh, cell, options).visible).size();
  options.sight_lines = RefinementOptions{}.sight_lines;
  const RefinedVisibility found = refine(mesh, cell, options);
  ++judged.scenes;
  judged.missing += missing_from(visible, found.visible).size();
  EXPECT_EQ(missing_from(found.visible, found.first_order.visible), Ids{});
  judged.gained += found.visible.size() < found.first_order.visible.size();
  std::uint64_t before = found.first_order.visible.size();
  for (const RefinementFigures& f : found.depths) {
    EXPECT_LE(f.visible, before);
    EXPECT_LE(f.witnessed, visible.size()) << "a sight line that is none";
    before = f.visible;
  }
  if (points == 0) return;
  options.regions = true;
  const RefinedVisibility with_areas = refine(mesh, cell, options);
  judged.missing += missing_from(visible, with_areas.visible).size();
  const RefinementFigures& last = with_areas.depths.back();
  EXPECT_LE(last.witnessed_area, last.refined_area * (1 + 1e-9));
  EXPECT_LE(last.refined_area, last.first_order_area * (1 + 1e-9));
  judge_points(mesh, cell, with_areas, points, judged);
}

void judge_kinds(const RefinementOptions& options, std::uint64_t per_kind, std::size_t most_triangles,
                 std::size_t points, Judged& judged) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    std::uint64_t done = 0;
    for (std::uint64_t i = 0; done < per_kind && i < 20 * per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      if (scene.mesh.triangles.size() > most_triangles) continue;
      SCOPED_TRACE(scene.name);
      judge(scene.mesh, scene.cell, options, points, judged);
      ++done;
    }
  }
}

void judge_generators(const RefinementOptions& options, std::uint64_t per_generator, std::size_t most_triangles,
                      Judged& judged) {
  const fuzz::GivenScenes none;
  for (const fuzz::NamedGenerator& generator : fuzz::generators_named({}, none)) {
    for (std::uint64_t i = 0; i < per_generator; ++i) {
      const fuzz::Case c = generator.make(kSeed, i);
      if (c.mesh.triangles.size() > most_triangles) continue;
      SCOPED_TRACE(generator.name + "-" + std::to_string(kSeed) + "-" + std::to_string(i));
      judge(c.mesh, c.cell, options, 0, judged);
    }
  }
}

void expect_sound(const Judged& j, const char* what) {
  EXPECT_EQ(j.missing, 0U);
  EXPECT_EQ(j.seen_points, 0U);
  EXPECT_GT(j.scenes, 0U);
  std::cout << what << ", seed " << kSeed << ": " << j.scenes << " scenes, " << j.gained
            << " with fewer triangles than first-order, " << j.hidden_points << " hidden points\n";
}

void judge_all(RefineBy by, const char* what, int depth, std::uint64_t per_kind, std::uint64_t per_generator,
               std::size_t most_triangles) {
  RefinementOptions options;
  options.by = by;
  options.max_depth = depth;
  Judged judged;
  judge_kinds(options, per_kind, most_triangles, 4, judged);
  judge_generators(options, per_generator, most_triangles, judged);
  EXPECT_GT(judged.hidden_points, 0U);
  expect_sound(judged, what);
}

TEST(FastRefinement, NothingVisibleIsLostByCells) { judge_all(RefineBy::cells, "cells", 3, 2, 1, 16); }
TEST(FastRefinement, NothingVisibleIsLostByBackprojection) {
  judge_all(RefineBy::backprojection, "backprojection", 3, 2, 1, 16);
}

TEST(FastRefinementLong, NothingVisibleIsLost) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_all(RefineBy::cells, "cells", 4, 40, 10, 24);
  judge_all(RefineBy::backprojection, "backprojection", 4, 40, 10, 24);
  judge_all(RefineBy::both, "both", 2, 20, 5, 24);
}

TEST(FastRefinement, TakesOutTilesBehindTwoSlits) {
  const Scene s = slits_and_tiles();
  RefinementOptions options;
  for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection, RefineBy::both}) {
    options.by = by;
    const RefinedVisibility found = refine(s.mesh, s.cell, options);
    EXPECT_LT(found.visible.size(), found.first_order.visible.size());
    EXPECT_GT(found.depths.back().witnessed, 0U);
    EXPECT_EQ(found.conservative_fallbacks, 0U);
    EXPECT_EQ(lost(s, found), 0U);
    // Sight lines save work; the answer is that of the maps.
    options.sight_lines = 0;
    if (by == RefineBy::cells) {
      EXPECT_EQ(refine(s.mesh, s.cell, options).visible, found.visible);
    }
    options.sight_lines = RefinementOptions{}.sight_lines;
  }
}

// Two or three walls with a slit each, at random angles, before a floor of tiles: much is visible to first order only.
Scene random_slits(std::uint64_t index) {
  fuzz::Random random(kSeed + index);
  constexpr double kWays[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  Scene s;
  const int walls = random.between(2, 3);
  for (int i = 0; i < walls; ++i) {
    const auto& [nx, ny] = kWays[random.between(0, 3)];
    const double at = random.between(-8, 8) / 16., width = random.between(1, 6) / 16.;
    s.half_plane(nx, ny, at + width, 2 * i + 2);
    s.half_plane(-nx, -ny, width - at, 2 * i + 2);
  }
  const double size = random.between(8, 12) / 8.;
  for (int x = -3; x < 3; ++x) {
    for (int y = -3; y < 3; ++y) s.plate(x * size, y * size, (x + 1) * size, (y + 1) * size, 2 * walls + 2);
  }
  s.cell = box({-1, -1, 0}, {1, random.between(-15, 16) / 16., random.between(0, 8) / 16.});
  return s;
}

void judge_slits(std::uint64_t scenes, int depth) {
  Judged judged;
  for (std::uint64_t i = 0; i < scenes; ++i) {
    SCOPED_TRACE(i);
    const Scene s = random_slits(i);
    RefinementOptions options;
    options.max_depth = depth;
    for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection}) {
      options.by = by;
      options.sight_lines = 0;
      options.regions = false;
      const RefinedVisibility found = refine(s.mesh, s.cell, options);
      ++judged.scenes;
      judged.gained += found.visible.size() < found.first_order.visible.size();
      judged.missing += lost(s, found);
      options.sight_lines = RefinementOptions{}.sight_lines;
      options.regions = true;
      const RefinedVisibility with_areas = refine(s.mesh, s.cell, options);
      judged.missing += lost(s, with_areas);
      judge_points(s.mesh, s.cell, with_areas, 16, judged);
    }
  }
  EXPECT_GT(judged.gained, 0U);
  expect_sound(judged, "slits");
}

TEST(FastRefinement, NothingVisibleIsLostBehindRandomSlits) { judge_slits(4, 2); }

TEST(FastRefinementLong, NothingVisibleIsLostBehindRandomSlits) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_slits(60, 4);
}

// The counterpart of tests/planted/one_half_only_test.cpp.
TEST(FastRefinement, NothingIsLostBehindTwoSlitsWithoutSightLines) {
  const Scene s = slits_and_tiles();
  RefinementOptions options;
  options.max_depth = 2;
  options.sight_lines = 0;
  for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection}) {
    options.by = by;
    EXPECT_EQ(lost(s, refine(s.mesh, s.cell, options)), 0U);
  }
}

// A screen in the cell hides nothing (D3). It lies above the lower part of the cell, and would hide the target from it, were that a cell of its own.
TEST(FastRefinement, GeometryInTheCellHidesNothingFromItsParts) {
  Scene s;
  s.plate(-7, -7, 7, 7, 0.75);
  const std::uint32_t target = s.plate(-2, -2, 2, 2, 6);
  s.cell = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-10, -10, 1}, {10, -10, 1}, {10, 10, 1}, {-10, 10, 1}};
  const auto whole = exact::ConvexCell::from_doubles(s.cell);
  const auto parts = parts_along(whole, {{0, 0, 0.25}, {0, 0, 1}});
  ASSERT_EQ(parts.size(), 2U);
  const exact::Complex complex = exact::build_complex(s.mesh, &whole);
  const std::vector<bool> all(s.mesh.triangles.size(), true);
  EXPECT_TRUE(lists(make_local_map_in(complex, whole, parts[0], {}, all).visible(), target));
  EXPECT_FALSE(lists(make_local_map(s.mesh, parts[0], {}).visible(), target))
      << "the literal reading hides the target: else this test shows nothing";
}

TEST(FastRefinement, HazardA4) {
  const HazardA4 s;
  const std::uint32_t target = s.target, near_target = s.near_target;

  const auto whole = exact::ConvexCell::from_doubles(s.cell);
  const LocalMap map = make_local_map(s.mesh, whole, {});
  const Bvh bvh(s.mesh);
  SegmentQueries queries(bvh);
  const auto plane = choose_cut(map.pieces(), whole, Cell(s.cell), {{{12, 0.1, 0.01}, 1}}, queries);
  ASSERT_TRUE(plane);
  // Through E, and through the cell at y = -1, where lines from E past O end.
  const auto value = [&](const Point& p) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += plane->normal[k] * (p[k] - plane->base[k]);
    return sum;
  };
  EXPECT_NEAR(value({10, 0, 5}), 0, 1e-12);
  EXPECT_NEAR(value({0, -1, 0}), 0, 1e-4);
  EXPECT_LT(value({0, -4, 0}), 0) << "V+";

  RefinementOptions options;
  options.by = RefineBy::backprojection;
  options.max_depth = 1;
  for (const bool areas : {false, true}) {
    options.regions = areas;
    const RefinedVisibility found = refined_visibility(bvh, s.cell, {}, options);
    EXPECT_TRUE(lists(found.visible, target) || lists(found.visible, target + 1));
    EXPECT_TRUE(lists(found.first_order.visible, near_target) && lists(found.first_order.visible, near_target + 1));
    EXPECT_FALSE(lists(found.visible, near_target) || lists(found.visible, near_target + 1))
        << "between the two wedges, and before the wedge of O: hidden from both parts of the cell";
  }
  const Ids visible = exactly_visible(s.mesh, s.cell);
  EXPECT_TRUE(lists(visible, target) || lists(visible, target + 1));
  EXPECT_FALSE(lists(visible, near_target) || lists(visible, near_target + 1));
}

}  // namespace
}  // namespace clues::fastpath
