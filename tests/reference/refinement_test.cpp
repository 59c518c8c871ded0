// Refinement (D20, D21, T4): what it gains on scenes with EEE events, and the scenes of the hazard list with their numbers. Soundness on random scenes is in
// refined_soundness_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/complex/cell_cut.h"
#include "fuzz/generators/skew_edges.h"
#include "judges.h"
#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/exactness.h"
#include "reference/visibility/refinement/subdivision.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::Bounds;
using reference::FlatSet;
using reference::RefineOptions;
using reference::side_index;

enum class By { cells, backprojection };

std::vector<reference::DepthFigures> refine(Bounds& bounds, By by, int depth) {
  const RefineOptions options{depth, 0};
  return by == By::cells ? refine_by_cells(bounds, options) : refine_by_backprojection(bounds, options);
}

// --- D21 --------------------------------------------------------------------------------------------------------------------

// A screen in the cell hides nothing (D3). It lies above the lower quarter of the cell, and would hide the target from it, were that a cell of its own.
TEST(Subdivision, GeometryInTheCellHidesNothingFromItsParts) {
  SceneBuilder scene;
  scene.plate(-7, -7, 7, 7, 0.75);
  const auto target = scene.plate(-2, -2, 2, 2, 6);
  const ConvexCell cell = ConvexCell::from_doubles(
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-10, -10, 1}, {10, -10, 1}, {10, 10, 1}, {-10, 10, 1}});
  const auto lower = exact::part_beside(cell, Plane3(0, 0, 4, -1), exact::Side::negative);
  ASSERT_TRUE(lower);
  Bounds bounds(scene.mesh(), cell, {});
  const std::vector<bool> all(2 * bounds.first_order().complex.pieces.size(), true);
  EXPECT_EQ(hidden_area(bounds.map_of(*lower, all), scene.mesh(), target, 2, false), FT(0));
  EXPECT_EQ(hidden_area(map_of(scene.mesh(), *lower), scene.mesh(), target, 2, false), FT(16))
      << "the literal reading hides the target: else this test shows nothing";
}

TEST(Subdivision, CellsOfAllDimensions) {
  const auto scene = fuzz::two_slits();
  for (const ConvexCell& cell :
       {box_cell(-1, -1, 0, 1, 1, 0.5), box_cell(-1, -1, 0, 1, 1, 0), box_cell(-1, 0.25, 0, 1, 0.25, 0)}) {
    Bounds bounds(scene.mesh, cell, {});
    const auto depths = refine(bounds, By::cells, 2);
    EXPECT_GE(depths.back().cells, 2U);
    EXPECT_LT(depths.back().area.excess(), depths.front().area.excess());
  }
  Bounds point(scene.mesh, box_cell(0, 0, 0, 0, 0, 0), {});
  refine(point, By::cells, 2);
  EXPECT_TRUE(point.closed()) << "from a point first order is exact";
}

// --- precision --------------------------------------------------------------------------------------------------------------

void expect_factor_four(const fuzz::GeneratedScene& scene, By by) {
  Bounds bounds(scene.mesh, ConvexCell::from_doubles(scene.cell), {});
  const auto depths = refine(bounds, by, 4);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto& a = depths[i].area;
    std::cout << "depth " << depths[i].depth << ": witnessed " << a.lower << ", refined " << a.upper << ", excess "
              << a.excess() << ", maps " << depths[i].maps << ", backprojections " << depths[i].backprojections
              << ", viewpoints " << depths[i].viewpoints << "\n";
    if (i == 0) continue;
    EXPECT_GE(a.lower, depths[i - 1].area.lower * (1 - 1e-12));
    EXPECT_LE(a.upper, depths[i - 1].area.upper * (1 + 1e-12));
  }
  EXPECT_GT(depths.front().area.excess(), 0) << "nothing to refine: this test shows nothing";
  EXPECT_LE(4 * depths.back().area.excess(), depths.front().area.excess());
}

// --- hazards ----------------------------------------------------------------------------------------------------------------

// A-4 with its numbers, drawn out along z: the cell is the strip x = 0, -4 <= y <= 0; a plate ends in the edge E at (10, 0); a small plate O at x = 8 hides
// y > -1 from E. The adjusted wedge is y = (x - 10) / 10; the point (100, 8.9) is below it, and is seen from (0, 0).
struct AdjustedWedge {
  SceneBuilder scene;
  std::uint32_t target, near_target;  // seen from (0, 0); hidden, and visible to first order
  ConvexCell cell = ConvexCell::from_doubles({{0, -4, -1}, {0, 0, -1}, {0, 0, 1}, {0, -4, 1}});
  AdjustedWedge() {
    scene.quad({10, -50, -64}, {10, 0, -64}, {10, 0, 64}, {10, -50, 64});
    scene.quad({8, -0.2, -64}, {8, 0.2, -64}, {8, 0.2, 64}, {8, -0.2, 64});
    target = scene.quad({100, 8.75, -1}, {100, 8.9375, -1}, {100, 8.9375, 1}, {100, 8.75, 1});
    near_target = scene.quad({12, 0.0625, -1}, {12, 0.125, -1}, {12, 0.125, 1}, {12, 0.0625, 1});
  }
};

TEST(Backprojection, HazardA4TheSegmentSeesThePartBelowMinusOne) {
  const AdjustedWedge it;
  const auto map = map_of(it.scene.mesh(), it.cell);
  const std::vector<bool> open(2 * map.complex.pieces.size(), true);
  bool found = false;
  for (const auto& s : inexact_segments(map, open)) {
    if (s.lo.x() != 10 || s.lo.y() != 0 || s.hi.y() != 0) continue;
    found = true;
    const auto seen = seen_by_segment(map.complex, s, it.cell, {});
    ASSERT_FALSE(seen.empty());
    const Plane3 plane = adjusted_plane(s, seen, it.cell).value();
    // O ends at the double nearest -0.2: the line from E past it meets the cell at 10/2 times that.
    const Point3 touched(0, FT(-0.2) * 5, 0);
    EXPECT_TRUE(plane.has_on(touched));
    EXPECT_EQ(plane.oriented_side(Point3(0, -4, 0)), CGAL::ON_NEGATIVE_SIDE);
  }
  EXPECT_TRUE(found);
}

TEST(Backprojection, HazardA4TheRawWedgeHidesWhatIsVisible) {
  const AdjustedWedge it;
  Bounds bounds(it.scene.mesh(), it.cell, {});
  const std::vector<bool> all(2 * bounds.first_order().complex.pieces.size(), true);
  const Plane3 adjusted(Point3(10, 0, -1), Point3(10, 0, 1), Point3(0, FT(-0.2) * 5, 0));
  FT hidden_raw(0), hidden_limited(0);
  const auto plus = part_beside(it.cell, adjusted, exact::Side::positive);
  const auto minus = part_beside(it.cell, adjusted, exact::Side::negative);
  ASSERT_TRUE(plus && minus);
  const bool positive_is_below = plus->vertices()[0].y() == -4;
  const auto from_plus = bounds.map_of(positive_is_below ? *plus : *minus, all);
  // The planted bug is to stop here: V- is not asked.
  EXPECT_FALSE(is_visible(from_plus, it.target, true, {100, 8.9, 0.01}) ||
               is_visible(from_plus, it.target, false, {100, 8.9, 0.01}))
      << "the raw adjusted wedge has no effect: this test shows nothing";
  EXPECT_GT(from_plus.statistics.regions_hidden, 0U);
  const auto map_contradictions = contradictions(
      [&] {
        auto raw = from_plus;
        raw.cell = it.cell;
        return raw;
      }(),
      4, kSeed);
  EXPECT_GT(map_contradictions.total(), 0U) << "the judges must catch the raw wedge";

  const scene::Point near{12, 0.1, 0.01};
  EXPECT_TRUE(is_visible(bounds.first_order(), it.near_target, true, near) ||
              is_visible(bounds.first_order(), it.near_target, false, near));
  refine_by_backprojection(bounds, {1, 0});
  const auto map = bounds.refined_map("backprojected");
  EXPECT_EQ(contradictions(map, 4, kSeed).total(), 0U);
  EXPECT_TRUE(is_visible(map, it.target, true, {100, 8.9, 0.01}) ||
              is_visible(map, it.target, false, {100, 8.9, 0.01}));
  EXPECT_FALSE(is_visible(map, it.near_target, true, near) || is_visible(map, it.near_target, false, near))
      << "between the two wedges, and before the wedge of O: hidden from both parts of the cell";
}

TEST(Backprojection, ThreeSkewEdgesCloseIn) { expect_factor_four(fuzz::three_skew_edges(), By::backprojection); }
TEST(Subdivision, ThreeSkewEdgesCloseIn) { expect_factor_four(fuzz::three_skew_edges(), By::cells); }

class RefinementLong : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  }
};

TEST_F(RefinementLong, TwoSlitsCloseInByBackprojection) { expect_factor_four(fuzz::two_slits(), By::backprojection); }
TEST_F(RefinementLong, TwoSlitsCloseInByCells) { expect_factor_four(fuzz::two_slits(), By::cells); }
TEST_F(RefinementLong, KeyholeClosesInByBackprojection) { expect_factor_four(fuzz::keyhole(), By::backprojection); }
TEST_F(RefinementLong, KeyholeClosesInByCells) { expect_factor_four(fuzz::keyhole(), By::cells); }

// --- FIG. 27 ----------------------------------------------------------------------------------------------------------------

// A wall with its upper edge along x, and a post before it: from the upper end of the cell it covers the edge for 0 <= x <= 2. The lower end looks past the post.
TEST(Exactness, OnlyThePartBehindThePostIsInDoubt) {
  SceneBuilder scene;
  scene.quad({-4, 0, 0}, {4, 0, 0}, {4, 0, 4}, {-4, 0, 4});
  scene.quad({0, -2, 0}, {1, -2, 0}, {1, -2, 8}, {0, -2, 8});
  scene.quad({-9, 8, 0}, {9, 8, 0}, {9, 8, 32}, {-9, 8, 32});
  const ConvexCell cell = ConvexCell::from_doubles({{0, -4, 0}, {3, -4, -0.5}});
  const auto map = map_of(scene.mesh(), cell);
  const exact::SceneQuery query(map.complex, map.cell);
  FT exact_length(0), other_length(0);
  for (const auto& w : map.wedges) {
    if (w.kind == reference::WedgeKind::se_mv || w.center != Point3(0, -4, 0)) continue;
    if (w.near0.z() != 4 || w.near1.z() != 4 || w.near0.y() != 0) continue;
    for (const auto& p : portions(query, w)) {
      const FT lo = std::min(p.lo.x(), p.hi.x()), hi = std::max(p.lo.x(), p.hi.x());
      (p.exact ? exact_length : other_length) += hi - lo;
      EXPECT_TRUE(p.exact ? hi <= 0 || lo >= 2 : lo >= 0 && hi <= 2) << lo << " " << hi;
    }
  }
  EXPECT_EQ(exact_length, FT(6));
  EXPECT_EQ(other_length, FT(2));
}

}  // namespace
}  // namespace clues::test
