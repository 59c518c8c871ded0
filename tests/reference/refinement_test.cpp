// Refined maps (D20, D21, T4) against what shares no algorithm with them: the point-occlusion oracle, exact sight lines, the exact visible set, and for
// the scenes with numbers in the hazard list those numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "exact/cell_cut.h"
#include "exact/point_occlusion.h"
#include "fuzz/generators/random_scenes.h"
#include "judges.h"
#include "reference/visibility/backprojection.h"
#include "reference/visibility/bounds.h"
#include "reference/visibility/exactness.h"
#include "reference/visibility/subdivision.h"
#include "validate/visible_set.h"

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

constexpr std::uint64_t kSeed = 20261121;

enum class By { cells, backprojection };

std::vector<reference::DepthFigures> refine(Bounds& bounds, By by, int depth) {
  const RefineOptions options{depth, 0};
  return by == By::cells ? refine_by_cells(bounds, options) : refine_by_backprojection(bounds, options);
}

// --- scenes -----------------------------------------------------------------------------------------------------------------

// Covers n . x >= g at height z, as far as 8; n has entries -1, 0, 1.
void half_plane(SceneBuilder& scene, double nx, double ny, double g, double z) {
  constexpr double r = 8;
  const double s = nx * nx + ny * ny, x = nx * g / s, y = ny * g / s;
  scene.quad({x + r * ny, y - r * nx, z}, {x + r * (ny + nx), y + r * (ny - nx), z},
             {x + r * (nx - ny), y + r * (ny + nx), z}, {x - r * ny, y + r * nx, z});
}

// Two slits that cross each other at an angle, in two walls: their edges and those of the cell make EEE events.
SceneBuilder two_slits() {
  SceneBuilder scene;
  half_plane(scene, 0, 1, 1 / 8., 2);
  half_plane(scene, 0, -1, 1 / 8., 2);
  half_plane(scene, 1, 1, 1 / 8., 4);
  half_plane(scene, -1, -1, 1 / 8., 4);
  scene.plate(-8, -8, 8, 8, 6);
  return scene;
}

// Three half planes at different heights, whose edges are mutually skew and leave a twisted hole.
SceneBuilder three_skew_edges() {
  SceneBuilder scene;
  half_plane(scene, 0, 1, 1 / 4., 2);
  half_plane(scene, 1, -1, 1 / 4., 3);
  half_plane(scene, -1, -1, 1 / 4., 4);
  scene.plate(-8, -8, 8, 8, 6);
  return scene;
}

// Four slits, each across the one before: what is seen through them is a small part of what each lets through.
SceneBuilder keyhole() {
  SceneBuilder scene;
  for (const auto& [nx, ny, z] : {std::array<double, 3>{1, 0, 1}, {0, 1, 2}, {1, 1, 3}, {1, -1, 4}}) {
    half_plane(scene, nx, ny, 1 / 16., z);
    half_plane(scene, -nx, -ny, 1 / 16., z);
  }
  scene.plate(-4, -4, 4, 4, 6);
  return scene;
}

// --- soundness --------------------------------------------------------------------------------------------------------------

struct Judged {
  std::uint64_t scenes = 0, gained = 0, decided = 0, points = 0, witnessed_points = 0;
};

// lower in E in upper in the first-order map, as far as three independent judges can tell.
void judge(const fuzz::GeneratedScene& scene, By by, int depth, std::size_t points, Judged& judged) {
  SCOPED_TRACE(scene.name);
  const ConvexCell cell = ConvexCell::from_doubles(scene.cell);
  Bounds bounds(scene.mesh, cell, {});
  const reference::SideSets first = bounds.upper();
  const auto depths = refine(bounds, by, depth);
  ++judged.scenes;
  judged.gained += depths.back().area.upper < depths.back().area.first_order;
  judged.decided += bounds.closed();
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(subtract(bounds.lower()[i], bounds.upper()[i]).empty()) << "side " << i;
    EXPECT_TRUE(subtract(bounds.upper()[i], first[i]).empty()) << "side " << i;
  }

  const auto map = bounds.refined_map("subdivided");
  const Contradictions c = contradictions(map, points, kSeed);
  EXPECT_EQ(c.total(), 0U);
  judged.points += c.points;
  std::vector<FT> covered(first.size(), FT(0));
  for (const auto& r : map.regions) covered[side_index(r.piece, r.front)] += r.area_fraction;
  for (const FT& f : covered) EXPECT_EQ(f, FT(1));

  const auto visible = validate::exact_visible_set(scene.mesh, cell);
  for (std::uint32_t t = 0; t < visible.triangles.size(); ++t) {
    if (visible.triangles[t].sight != validate::Sight::visible) continue;
    EXPECT_TRUE(std::binary_search(map.visible.begin(), map.visible.end(), t)) << "triangle " << t << " is visible";
  }

  // Points of the lower bound are seen.
  std::vector<exact::TriangleCorners> corners;
  for (const exact::Piece& p : map.complex.pieces)
    corners.push_back(
        {map.complex.points[p.corners[0]], map.complex.points[p.corners[1]], map.complex.points[p.corners[2]]});
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto t = static_cast<std::uint32_t>(i / 2);
    if (map.complex.in_cell[t]) continue;
    const reference::TriangleFrame frame(map.complex, t);
    const Plane3 side = i % 2 == 0 ? map.complex.planes[t] : map.complex.planes[t].opposite();
    for (const auto& face : bounds.lower()[i].faces()) {
      const Point3 p = frame.lift(reference::inner_point(face, 0));
      EXPECT_FALSE(exact::point_occlusion(p, side, cell, corners).occluded) << "side " << i;
      ++judged.witnessed_points;
    }
  }
}

void judge_kinds(By by, std::uint64_t per_kind, int depth, std::size_t points, std::size_t most_triangles) {
  Judged judged;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    std::uint64_t done = 0;
    for (std::uint64_t i = 0; done < per_kind && i < 20 * per_kind; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      if (scene.mesh.triangles.size() > most_triangles) continue;
      judge(scene, by, depth, points, judged);
      ++done;
    }
  }
  EXPECT_GT(judged.gained, 0U);
  EXPECT_GT(judged.points, 0U);
  std::cout << "seed " << kSeed << ", depth " << depth << ": " << judged.scenes << " scenes, " << judged.gained
            << " with less area than first-order, " << judged.decided << " decided; " << judged.points
            << " hidden points, " << judged.witnessed_points << " faces of the lower bound\n";
}

TEST(Refinement, NothingHiddenIsSeenByCells) { judge_kinds(By::cells, 2, 2, 2, 16); }
TEST(Refinement, NothingHiddenIsSeenByBackprojection) { judge_kinds(By::backprojection, 1, 1, 2, 16); }

TEST(RefinementLong, NothingHiddenIsSeen) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  judge_kinds(By::cells, 84, 2, 2, 40);
  judge_kinds(By::backprojection, 84, 2, 2, 24);
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
  const SceneBuilder scene = two_slits();
  for (const ConvexCell& cell :
       {box_cell(-1, -1, 0, 1, 1, 0.5), box_cell(-1, -1, 0, 1, 1, 0), box_cell(-1, 0.25, 0, 1, 0.25, 0)}) {
    Bounds bounds(scene.mesh(), cell, {});
    const auto depths = refine(bounds, By::cells, 2);
    EXPECT_GE(depths.back().cells, 2U);
    EXPECT_LT(depths.back().area.excess(), depths.front().area.excess());
  }
  Bounds point(scene.mesh(), box_cell(0, 0, 0, 0, 0, 0), {});
  refine(point, By::cells, 2);
  EXPECT_TRUE(point.closed()) << "from a point first order is exact";
}

// --- precision --------------------------------------------------------------------------------------------------------------

void expect_factor_four(const SceneBuilder& scene, const ConvexCell& cell, By by) {
  Bounds bounds(scene.mesh(), cell, {});
  const auto depths = refine(bounds, by, 4);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto& a = depths[i].area;
    std::cout << "depth " << depths[i].depth << ": witnessed " << a.lower << ", refined " << a.upper << ", excess "
              << a.excess() << ", maps " << depths[i].maps << "\n";
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
    const Plane3 plane = adjusted_plane(s, seen, it.cell);
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

TEST(Backprojection, TwoSlitsCloseIn) {
  expect_factor_four(two_slits(), box_cell(-1, -1, 0, 1, 1, 0.5), By::backprojection);
}
TEST(Subdivision, TwoSlitsCloseIn) { expect_factor_four(two_slits(), box_cell(-1, -1, 0, 1, 1, 0.5), By::cells); }
TEST(Backprojection, ThreeSkewEdgesCloseIn) {
  expect_factor_four(three_skew_edges(), box_cell(-1, -1, 0, 1, 1, 0.5), By::backprojection);
}
TEST(Subdivision, ThreeSkewEdgesCloseIn) {
  expect_factor_four(three_skew_edges(), box_cell(-1, -1, 0, 1, 1, 0.5), By::cells);
}
TEST(Subdivision, KeyholeClosesIn) { expect_factor_four(keyhole(), box_cell(-0.5, -0.5, -1, 0.5, 0.5, 0), By::cells); }

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
