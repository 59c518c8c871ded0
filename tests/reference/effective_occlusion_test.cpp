// Effective static occlusion and the simplification of maps (FIG. 30): scenes built by hand, and random scenes against the independent
// judges. The literal readings (hazards) are in tests/planted.
#include "reference/visibility/hidden/effective_occlusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "judges.h"
#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"
#include "shadow_scenes.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using reference::hides_no_more;
using reference::occlusion_regions;
using reference::OcclusionControls;
using reference::SimplifiedMap;
using reference::VisibilityMap;
using reference::with_simpler_occlusion;

std::string bytes_of(const VisibilityMap& map) { return scene::to_json_text(reference::to_result(map, {}, true)); }

// The one region that has a boundary; the inside of the box, which is wholly hidden, is another and has none.
reference::OcclusionRegion shadow_in(const VisibilityMap& map) {
  auto regions = occlusion_regions(map);
  std::erase_if(regions, [](const auto& r) { return r.segments == 0; });
  EXPECT_EQ(regions.size(), 1U);
  return regions.at(0);
}

TEST(EffectiveOcclusion, Fig30AShadowWithinOneTriangle) {
  const Fig30 fig;
  const VisibilityMap map = map_of(fig.s.mesh(), fig.cell);
  EXPECT_EQ(occlusion_regions(map).size(), 2U);
  const auto shadow = shadow_in(map);
  EXPECT_EQ(shadow.segments, 7U);
  EXPECT_EQ(shadow.whole_pieces, 0U);
  ASSERT_EQ(shadow.triangles.size(), 1U);
  const exact::FT area = hidden_area(map, fig.s.mesh(), shadow.triangles[0], 1, true);
  EXPECT_DOUBLE_EQ(shadow.hidden_area, CGAL::to_double(area));
  EXPECT_DOUBLE_EQ(shadow.effective(), CGAL::to_double(area) / 7);
}

TEST(EffectiveOcclusion, Fig30RemovalBelowTheThresholdAndNotAtIt) {
  const Fig30 fig;
  const VisibilityMap map = map_of(fig.s.mesh(), fig.cell);
  const double effective = shadow_in(map).effective();
  EXPECT_EQ(bytes_of(with_simpler_occlusion(map, controls(effective, 0)).map), bytes_of(map));
  const SimplifiedMap removed = with_simpler_occlusion(map, controls(1.001 * effective, 0));
  EXPECT_TRUE(hides_no_more(map, removed.map));
  EXPECT_FALSE(hides_no_more(removed.map, map));
  EXPECT_EQ(removed.before.segments, 7U);
  EXPECT_EQ(removed.after.segments, 0U);
  EXPECT_EQ(removed.after.regions, 1U) << "what has no boundary stays hidden";
  EXPECT_EQ(removed.map.visible, map.visible) << "a triangle that is partly hidden was in the PVS already";
}

TEST(EffectiveOcclusion, Fig30SimplifiedKeepsWhatItMust) {
  const Fig30 fig;
  const VisibilityMap map = map_of(fig.s.mesh(), fig.cell);
  const std::uint32_t receiver = shadow_in(map).triangles.at(0);
  const exact::FT before = hidden_area(map, fig.s.mesh(), receiver, 1, true);
  std::uint64_t last = 7;
  for (const double loss : {0.05, 0.125, 0.25, 0.5, 1.0}) {
    const SimplifiedMap out = with_simpler_occlusion(map, controls(0, loss));
    EXPECT_TRUE(hides_no_more(map, out.map));
    EXPECT_GE(hidden_area(out.map, fig.s.mesh(), receiver, 1, true), (exact::FT(1) - exact::FT(loss)) * before);
    EXPECT_LE(out.after.segments, last);
    last = out.after.segments;
  }
  EXPECT_EQ(last, 3U) << "never less than a contour has";
}

// A shadow over sixteen squares, the four in the middle wholly in it: one region.
SceneBuilder tiles(bool with_fin) {
  SceneBuilder s;
  for (int x = -8; x < 8; x += 4) {
    for (int y = -8; y < 8; y += 4) s.plate(x, y, x + 4, y + 4, 6);
  }
  s.plate(-3, -3, 3, 3, 3);
  if (with_fin) s.quad({0, -8, 6}, {0, 8, 6}, {0, 8, 9}, {0, -8, 9});
  return s;
}

TEST(EffectiveOcclusion, HiddenRegionsOfNeighboursAreOneOcclusionRegion) {
  const SceneBuilder s = tiles(false);
  const VisibilityMap map = map_of(s.mesh(), box_cell(-0.25, -0.25, -1, 0.25, 0.25, 0));
  const auto regions = occlusion_regions(map);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].whole_pieces, 8U);
  EXPECT_EQ(regions[0].triangles.size(), 30U) << "the shadow does not reach into the halves of two corners";
  EXPECT_NEAR(regions[0].hidden_area - regions[0].bordered_area, 8 * 8, 1e-9);
  const SimplifiedMap out = with_simpler_occlusion(map, controls(1.001 * regions[0].effective(), 0));
  EXPECT_EQ(out.after.segments, 0U);
  EXPECT_NEAR(out.after.hidden_area, 8 * 8, 1e-9) << "the eight triangles in the middle cost nothing and stay";
  EXPECT_EQ(out.map.visible, map.visible);
}

TEST(EffectiveOcclusion, WhereAnotherSurfaceBeginsAnotherRegionBegins) {
  const SceneBuilder s = tiles(true);
  const VisibilityMap map = map_of(s.mesh(), box_cell(-0.25, -0.25, -1, 0.25, 0.25, 0));
  auto regions = occlusion_regions(map);
  std::erase_if(regions, [](const auto& r) { return r.segments == 0; });
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].segments, regions[1].segments);
}

// Along the edges of the tiles the hidden parts of neighbours end in the same points, before and after.
TEST(EffectiveOcclusion, NeighboursStillAgreeAboutTheirEdge) {
  const SceneBuilder s = tiles(false);
  const VisibilityMap map = map_of(s.mesh(), box_cell(-0.25, -0.125, -1, 0.25, 0.25, 0));
  const SimplifiedMap out = with_simpler_occlusion(map, controls(0, 1));
  const auto corners_on_tile_edges = [](const VisibilityMap& m) {
    std::vector<exact::Point3> points;
    for (const reference::Region& r : m.regions) {
      if (r.visible || m.complex.planes[r.piece].has_on(exact::Point3(0, 0, 3))) continue;
      for (const exact::Point3& p : r.rings[0]) {
        if (p.x() == exact::FT(4) || p.x() == exact::FT(-4) || p.y() == exact::FT(4) || p.y() == exact::FT(-4))
          points.push_back(p);
      }
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  };
  EXPECT_EQ(corners_on_tile_edges(out.map), corners_on_tile_edges(map));
}

TEST(EffectiveOcclusion, HazardA16AChordIsTakenOnlyInsideTheOldRegion) {
  const Window window;
  const VisibilityMap map = map_of(window.s.mesh(), window.cell);
  const SimplifiedMap ours = with_simpler_occlusion(map, controls(0, 1));
  EXPECT_TRUE(hides_no_more(map, ours.map));
  EXPECT_EQ(contradictions(ours.map, 8, kSeed).total(), 0U);
}

// the shadow's sides extended on the side that a line in space calls the best, which on the receiver is the outside.
TEST(EffectiveOcclusion, HazardA17TheSideIsDecidedOnTheReceiver) {
  const Fig30 fig;
  const VisibilityMap map = map_of(fig.s.mesh(), fig.cell);
  const SimplifiedMap ours = with_simpler_occlusion(map, controls(0, 0.5));
  EXPECT_LT(ours.after.segments, ours.before.segments);
  EXPECT_TRUE(hides_no_more(map, ours.map));
  EXPECT_EQ(contradictions(ours.map, 8, kSeed).total(), 0U);
}

// --- random scenes ------------------------------------------------------------------------------------------------------------

// What is said of a simplified map, measured again on it.
void expect_true_figures(const SimplifiedMap& out) {
  reference::OcclusionFigures measured;
  for (const auto& region : occlusion_regions(out.map)) {
    ++measured.regions;
    measured.segments += region.segments;
    measured.hidden_area += region.hidden_area;
  }
  EXPECT_EQ(measured.regions, out.after.regions);
  EXPECT_EQ(measured.segments, out.after.segments);
  EXPECT_NEAR(measured.hidden_area, out.after.hidden_area, 1e-9 * out.after.hidden_area) << "summed in another order";
  const scene::Result result = reference::to_result(out.map, {}, true);
  const auto borders =
      std::count_if(result.mesh.edges.begin(), result.mesh.edges.end(), [](const auto& e) { return e.kind == "ob"; });
  const auto segments =
      std::count_if(out.map.segments.begin(), out.map.segments.end(), [](const auto& s) { return s.boundary; });
  EXPECT_EQ(borders, segments) << "regions on the two sides of a segment share its ends";
}

void expect_less(const SimplifiedMap& more, const SimplifiedMap& less) {
  EXPECT_TRUE(hides_no_more(more.map, less.map));
  EXPECT_LE(less.after.segments, more.after.segments);
  EXPECT_LE(less.after.hidden_area, more.after.hidden_area);
  EXPECT_EQ(less.map.visible, more.map.visible);
}

struct Saved {
  std::uint64_t before = 0, simplified = 0, points = 0;
};

void judge(const VisibilityMap& map, std::size_t points, Saved& saved) {
  SimplifiedMap last = with_simpler_occlusion(map, controls(0, 0));
  EXPECT_EQ(bytes_of(last.map), bytes_of(map));
  EXPECT_EQ(last.before.segments, last.after.segments);
  EXPECT_EQ(last.before.hidden_area, last.after.hidden_area);
  const std::uint64_t before = last.before.segments;
  const auto expect_sound = [&](const SimplifiedMap& out) {
    const Contradictions c = contradictions(out.map, points, kSeed);
    EXPECT_EQ(c.total(), 0U);
    EXPECT_EQ(c.invalid_witnesses, 0U);
    saved.points += c.points;
    expect_true_figures(out);
  };
  for (const double loss : {0.05, 0.25, 1.0}) {
    SimplifiedMap out = with_simpler_occlusion(map, controls(0, loss));
    expect_less(last, out);
    EXPECT_GE(out.after.hidden_area, (1 - loss) * out.before.hidden_area * (1 - 1e-9));
    last = std::move(out);
  }
  expect_sound(last);
  saved.before += before;
  saved.simplified += last.after.segments;
  last = with_simpler_occlusion(map, controls(0, 0.1));
  for (const double area : {0.125, 2.0, 1e9}) {
    SimplifiedMap out = with_simpler_occlusion(map, controls(area, 0.1));
    expect_less(last, out);
    if (area == 2.0) expect_sound(out);
    last = std::move(out);
  }
  EXPECT_EQ(last.after.segments, 0U);
}

void judge_scenes(std::uint64_t per_kind, std::size_t points) {
  Saved saved;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      reference::Options options;
      if (scene.solid && i % 2 == 1) options.mode = reference::Mode::solid;
      judge(map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options), points, saved);
    }
  }
  EXPECT_LT(saved.simplified, saved.before);
  EXPECT_GT(saved.points, 0U);
  std::cout << "seed " << kSeed << ", " << per_kind << " scenes of each kind: " << saved.before << " segments, "
            << saved.simplified << " where everything but a contour may go; " << saved.points
            << " hidden points by the oracle\n";
}

TEST(EffectiveOcclusion, NothingBecomesHiddenInRandomScenes) { judge_scenes(2, 2); }

TEST(EffectiveOcclusionLong, NothingBecomesHiddenInRandomScenes) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_scenes(40, 10);
}

TEST(EffectiveOcclusion, TheSameBytesForEveryThreadCountAndBothFormulations) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, 1);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const VisibilityMap map = map_of(scene.mesh, cell);
    OcclusionControls one = controls(0.25, 0.25), two = one;
    two.threads = 2;
    const SimplifiedMap first = with_simpler_occlusion(map, one), second = with_simpler_occlusion(map, two);
    EXPECT_EQ(bytes_of(first.map), bytes_of(second.map));
    EXPECT_EQ(first.after.hidden_area, second.after.hidden_area);

    reference::Options options;
    options.formulation = reference::Formulation::traversal;
    const SimplifiedMap outward = with_simpler_occlusion(map_of(scene.mesh, cell, options), one);
    EXPECT_TRUE(hides_no_more(first.map, outward.map));
    EXPECT_TRUE(hides_no_more(outward.map, first.map));
    EXPECT_EQ(outward.after.segments, first.after.segments);
    EXPECT_EQ(outward.map.visible, first.map.visible);
  }
}

TEST(EffectiveOcclusion, RefinedMapsAreSimplifiedToo) {
  Saved saved;
  for (const fuzz::Kind kind : {fuzz::Kind::loose_triangles, fuzz::Kind::axis_boxes}) {
    const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, 0);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    for (const bool by_cells : {true, false}) {
      reference::Bounds bounds(scene.mesh, cell, {});
      if (by_cells)
        refine_by_cells(bounds, {1, 0});
      else
        refine_by_backprojection(bounds, {1, 0});
      judge(bounds.refined_map(by_cells ? "subdivided" : "backprojected"), 2, saved);
    }
  }
  EXPECT_LT(saved.simplified, saved.before);
}

}  // namespace
}  // namespace clues::test
