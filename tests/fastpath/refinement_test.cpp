// Refined maps of the fast path against what shares no algorithm with them: the exact visible set, the point-occlusion oracle, and for the scenes with numbers in the
// hazard list those numbers. tests/differential compares them with the reference's.
#include "fastpath/visibility/refinement/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "exact/complex/complex.h"
#include "exact/sight/point_occlusion.h"
#include "fastpath/visibility/refinement/adjusted_cut.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "slit_scenes.h"
#include "validate/visible_set/visible_set.h"

namespace clues::fastpath {
namespace {

constexpr std::uint64_t kSeed = 20261121;

Ids exactly_visible(const scene::TriangleMesh& mesh, const std::vector<Point>& cell) {
  const auto set = validate::exact_visible_set(mesh, exact::ConvexCell::from_doubles(cell));
  Ids ids;
  for (std::uint32_t t = 0; t < set.triangles.size(); ++t) {
    if (set.triangles[t].sight == validate::Sight::visible) ids.push_back(t);
  }
  return ids;
}

// --- soundness --------------------------------------------------------------------------------------------------------------

struct Judged {
  std::uint64_t scenes = 0, gained = 0, missing = 0, hidden_points = 0, seen_points = 0;
};

// Points just off the middles of hidden polygons, far from their borders for what doubles are off.
void judge_points(const scene::TriangleMesh& mesh, const std::vector<Point>& cell, const RefinedVisibility& found,
                  std::size_t most, Judged& judged) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  std::vector<exact::TriangleCorners> corners;
  const Bvh bvh(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(bvh.degenerate().begin(), bvh.degenerate().end(), t)) continue;
    const Corners c = bvh.corners(t);
    corners.push_back({exact::to_exact(c[0]), exact::to_exact(c[1]), exact::to_exact(c[2])});
  }
  for (const LocalRegion& r : found.first_order.regions) {
    if (r.visible || most == 0) continue;
    const Corners c = bvh.corners(r.triangle);
    // A side that faces away is hidden (D4), but points just off it are seen past its edges if the cell reaches up to its plane.
    const exact::Plane3 plane(exact::to_exact(c[0]), exact::to_exact(c[1]), exact::to_exact(c[2]));
    const auto in_front = r.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    const auto& s = exact_cell.vertices();
    if (std::none_of(s.begin(), s.end(), [&](const auto& v) { return plane.oriented_side(v) == in_front; })) continue;
    Point n{}, middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = (c[1][j] - c[0][j]) * (c[2][k] - c[0][k]) - (c[1][k] - c[0][k]) * (c[2][j] - c[0][j]);
      for (const Point& p : r.outline_estimate) middle[i] += p[i] / static_cast<double>(r.outline_estimate.size());
    }
    const double size = std::hypot(n[0], n[1], n[2]);
    const auto across = [&](const Point& a, const Point& b) {  // twice the area beside an edge
      Point x{};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = (a[j] - middle[j]) * (b[k] - middle[k]) - (a[k] - middle[k]) * (b[j] - middle[j]);
      }
      return std::hypot(x[0], x[1], x[2]);
    };
    bool small = false;
    for (std::size_t i = 0; i < r.outline_estimate.size(); ++i)
      small |= across(r.outline_estimate[i], r.outline_estimate[(i + 1) % r.outline_estimate.size()]) < 1e-4 * size;
    if (small) continue;
    for (std::size_t i = 0; i < 3; ++i) middle[i] += (r.front ? 1e-9 : -1e-9) * n[i] / std::sqrt(size);
    --most;
    ++judged.hidden_points;
    judged.seen_points += !exact::point_occlusion(exact::to_exact(middle), std::nullopt, exact_cell, corners).occluded;
  }
}

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

// How many of the triangles that refinement took out are seen after all.
std::uint64_t lost(const Scene& s, const RefinedVisibility& found) {
  validate::VisibleSetOptions only;
  only.only = missing_from(found.first_order.visible, found.visible);
  const auto exact = validate::exact_visible_set(s.mesh, exact::ConvexCell::from_doubles(s.cell), only);
  return static_cast<std::uint64_t>(std::count_if(only.only.begin(), only.only.end(), [&](std::uint32_t t) {
    return exact.triangles[t].sight != validate::Sight::hidden;
  }));
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

// The planted bug: the raw adjusted wedge, which is the map of V+ without V-.
TEST(FastRefinement, JudgesCatchAHalfThatIsNotAsked) {
  const Scene s = slits_and_tiles();
  RefinementOptions options;
  options.max_depth = 2;
  options.sight_lines = 0;
  for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection}) {
    options.by = by;
    options.planted_bug = RefinementBug::none;
    EXPECT_EQ(lost(s, refine(s.mesh, s.cell, options)), 0U);
    options.planted_bug = RefinementBug::one_half_only;
    EXPECT_GT(lost(s, refine(s.mesh, s.cell, options)), 0U);
    options.regions = true;
    Judged judged;
    judge_points(s.mesh, s.cell, refine(s.mesh, s.cell, options), 2000, judged);
    options.regions = false;
    EXPECT_GT(judged.seen_points, 0U);
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

// A-4 with its numbers, drawn out along z: the cell is the strip x = 0, -4 <= y <= 0; a plate ends in the edge E at (10, 0); a small plate O at x = 8 hides
// y > -1 from E. The adjusted wedge is y = (x - 10) / 10; the point (100, 8.9) is below it, and is seen from (0, 0).
TEST(FastRefinement, HazardA4) {
  Scene s;
  s.quad({10, -50, -64}, {10, 0, -64}, {10, 0, 64}, {10, -50, 64});
  s.quad({8, -0.2, -64}, {8, 0.2, -64}, {8, 0.2, 64}, {8, -0.2, 64});
  const auto target = s.quad({100, 8.75, -1}, {100, 8.9375, -1}, {100, 8.9375, 1}, {100, 8.75, 1});
  const auto near_target = s.quad({12, 0.0625, -1}, {12, 0.125, -1}, {12, 0.125, 1}, {12, 0.0625, 1});
  s.cell = {{0, -4, -1}, {0, 0, -1}, {0, 0, 1}, {0, -4, 1}};

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
    options.planted_bug = RefinementBug::none;
    const RefinedVisibility found = refined_visibility(bvh, s.cell, {}, options);
    EXPECT_TRUE(lists(found.visible, target) || lists(found.visible, target + 1));
    if (!areas) {
      options.sight_lines = 0;
      options.planted_bug = RefinementBug::one_half_only;
      const Ids raw = refined_visibility(bvh, s.cell, {}, options).visible;
      EXPECT_FALSE(lists(raw, target) || lists(raw, target + 1)) << "the raw adjusted wedge hides what is seen";
      options.sight_lines = RefinementOptions{}.sight_lines;
    }
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
