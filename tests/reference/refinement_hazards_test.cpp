// Hazards of the published text about backprojection (LIST (a) of its restatement): that nothing of the kind happens here. What the text does, read literally, is in
// literal_backprojection_test.cpp. A-4 is in refinement_test.cpp; docs/hazards.md has the whole list.
#include <gtest/gtest.h>

#include <algorithm>

#include "exact/complex/cell_cut.h"
#include "fuzz/generators/skew_edges.h"
#include "judges.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/deviation.h"
#include "reference/visibility/refinement/retraction.h"
#include "strip_scenes.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::Bounds;
using reference::ContourSegment;

std::vector<bool> all_sides(const exact::Complex& complex) {
  return std::vector<bool>(2 * complex.pieces.size(), true);
}

// A single plate has no edge with two triangles but its diagonal, and its back may be what the segment sees. Taken with one side only, or with silhouettes where two
// triangles meet, it hides nothing or has walls missing.
TEST(Backprojection, HazardA7OpenSheetsHideFromASegmentWhicheverWayTheyAreTurned) {
  for (const bool turned : {false, true}) {
    SceneBuilder scene = plate_below();
    if (turned) {
      scene.quad({5, -0.5, 64}, {5, 0.5, 64}, {5, 0.5, -64}, {5, -0.5, -64});
    } else {
      scene.quad({5, -0.5, -64}, {5, 0.5, -64}, {5, 0.5, 64}, {5, -0.5, 64});
    }
    const auto complex = exact::build_complex(scene.mesh(), &kStrip);
    const auto seen = seen_by_segment(complex, segment_at_ten(complex), kStrip, {});
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(highest_y(seen), FT(-1)) << turned;
    EXPECT_EQ(lowest_y(seen), FT(-4)) << turned;
  }
}

// Cuts along one edge's planes cross in the line of that edge only. Parallel traces or not, the parts they cut off V are nested.
TEST(Backprojection, HazardA9CutsOfOneEdgeAreNested) {
  const auto scene = fuzz::three_skew_edges();
  const ConvexCell cell = ConvexCell::from_doubles(scene.cell);
  const auto map = map_of(scene.mesh, cell);
  std::size_t pairs = 0, not_parallel = 0;
  for (const auto& s : inexact_segments(map, all_sides(map.complex))) {
    const Point3 middle = CGAL::midpoint(s.lo, s.hi);
    std::vector<Plane3> planes;
    for (const auto& part : {ContourSegment{s.edge, s.lo, middle, s.plane, s.center},
                             ContourSegment{s.edge, middle, s.hi, s.plane, s.center}}) {
      const auto plane = adjusted_plane(part, seen_by_segment(map.complex, part, cell, {}), cell);
      if (plane) planes.push_back(*plane);
    }
    if (planes.size() < 2 || planes[0] == planes[1]) continue;
    const auto a = exact::part_beside(cell, planes[0], exact::Side::negative);
    const auto b = exact::part_beside(cell, planes[1], exact::Side::negative);
    if (!a || !b) continue;
    ++pairs;
    const auto all_of = [](const ConvexCell& part, const Plane3& plane) {
      return std::all_of(part.vertices().begin(), part.vertices().end(),
                         [&](const Point3& v) { return plane.oriented_side(v) != CGAL::ON_POSITIVE_SIDE; });
    };
    EXPECT_TRUE(all_of(*a, planes[1]) || all_of(*b, planes[0]));
    // The traces on a facet of the cell are not parallel to the edge: to call the adjusted wedge SE-ME is wrong.
    for (const auto& facet : cell.facets()) {
      const auto trace = CGAL::cross_product(facet.plane.orthogonal_vector(), planes[0].orthogonal_vector());
      not_parallel += CGAL::cross_product(trace, s.hi - s.lo) != CGAL::NULL_VECTOR;
    }
  }
  EXPECT_GT(pairs, 0U);
  EXPECT_GT(not_parallel, 0U);
}

// The scene of A-4 before a wall that stays partly in doubt, so that what is called hidden there rests on the maps of both halves alone.
TEST(Backprojection, HazardA4BothHalvesAreAsked) {
  SceneBuilder scene = plate_below();
  scene.quad({8, -0.25, -64}, {8, 0.25, -64}, {8, 0.25, 64}, {8, -0.25, 64});
  scene.quad({40, 0.5, -64}, {40, 8, -64}, {40, 8, 64}, {40, 0.5, 64});
  Bounds bounds(scene.mesh(), kStrip, {});
  const auto depths = refine_by_backprojection(bounds, {2, 0});
  EXPECT_GT(depths.back().cells, 1U) << "nothing was cut: this test shows nothing";
  const auto contradicted = contradictions(bounds.refined_map("backprojected"), 16, kSeed);
  EXPECT_GT(contradicted.points, 0U);
  EXPECT_EQ(contradicted.total(), 0U);
}

// The segment sees nothing of V: there is no VSVV. To drop its wedge opens the umbra; it stays, and what hides the segment is refined on its own.
TEST(Backprojection, HazardA11ASegmentThatSeesNothingKeepsItsWedge) {
  SceneBuilder scene = plate_below();
  scene.quad({5, -20, -64}, {5, 0.5, -64}, {5, 0.5, 64}, {5, -20, 64});
  scene.quad({20, -8, -8}, {20, 8, -8}, {20, 8, 8}, {20, -8, 8});
  const auto complex = exact::build_complex(scene.mesh(), &kStrip);
  const ContourSegment s = segment_at_ten(complex);
  const auto seen = seen_by_segment(complex, s, kStrip, {});
  EXPECT_TRUE(seen.empty());
  EXPECT_FALSE(adjusted_plane(s, seen, kStrip));
  Bounds bounds(scene.mesh(), kStrip, {});
  refine_by_backprojection(bounds, {2, 0});
  const auto map = bounds.refined_map("backprojected");
  const auto contradicted = contradictions(map, 4, kSeed);
  EXPECT_GT(contradicted.points, 0U);
  EXPECT_EQ(contradicted.total(), 0U);
}

// Deviation and threshold equal: nothing is adjusted. Between two planes is what is there, no more.
TEST(Deviation, HazardA29NothingIsBetweenEqualPlanes) {
  SceneBuilder scene = plate_below();
  scene.quad({100, 8, -1}, {100, 10, -1}, {100, 10, 1}, {100, 8, 1});
  const auto map = map_of(scene.mesh(), kStrip);
  const ContourSegment s = segment_at_ten(map.complex);
  const Plane3 separating = separating_plane(s, kStrip);
  EXPECT_TRUE(separating.has_on(Point3(0, -4, 0)));
  EXPECT_EQ(separating.oriented_side(Point3(0, 0, 0)), CGAL::ON_POSITIVE_SIDE);

  const Bounds bounds(scene.mesh(), kStrip, {});
  const reference::DoubtfulArea doubtful(bounds, bounds.upper(), all_sides(map.complex));
  EXPECT_EQ(doubtful.between(s.plane, s.plane), 0);
  EXPECT_DOUBLE_EQ(doubtful.between(s.plane, separating), 4) << "the whole far plate, on the side that faces the cell";
  EXPECT_DOUBLE_EQ(doubtful.between(s.plane, Plane3(Point3(10, 0, -1), Point3(10, 0, 1), Point3(0, -1, 0))), 2)
      << "its half below the plane y = (x - 10) / 10";
}

// VSVE "visible from the entire silhouette edge" is too little: the post hides the lower end of the cell from half of the edge only.
TEST(Backprojection, HazardA30WhatAnyPartOfTheSegmentSeesCounts) {
  SceneBuilder scene = plate_below();
  scene.quad({5, -3, 0}, {5, 3, 0}, {5, 3, 64}, {5, -3, 64});
  const auto complex = exact::build_complex(scene.mesh(), &kStrip);
  const ContourSegment s = segment_at_ten(complex);
  EXPECT_EQ(highest_y(seen_by_segment(complex, s, kStrip, {})), FT(0));
  // The entire edge sees only what its upper end sees, too.
  ContourSegment upper = s;
  upper.lo = Point3(10, 0, 32);
  EXPECT_TRUE(seen_by_segment(complex, upper, kStrip, {}).empty());
  Bounds bounds(scene.mesh(), kStrip, {});
  refine_by_backprojection(bounds, {2, 0});
  EXPECT_EQ(contradictions(bounds.refined_map("backprojected"), 4, kSeed).total(), 0U);
}

// A roof: its upper sheet ends in E = (10, 0), its lower one goes from E towards the cell and ends in F = (5, -0.25); a plate hides y > -1.25 from E. Seen from below
// the roof F is the silhouette, and the plane through E runs into the roof.
struct Roof {
  SceneBuilder scene;
  std::uint32_t target;
  Roof() {
    scene.quad({10, 0, -64}, {12, -4, -64}, {12, -4, 64}, {10, 0, 64});
    scene.quad({10, 0, -64}, {5, -0.25, -64}, {5, -0.25, 64}, {10, 0, 64});
    scene.quad({4, -0.75, -64}, {4, 0.25, -64}, {4, 0.25, 64}, {4, -0.75, 64});
    target = scene.quad({40, -8, -64}, {40, 8, -64}, {40, 8, 64}, {40, -8, 64});
  }
};

// What of the roof stands before its own edge hides the cell from it, as any occluder does. Left out as "connected with the edge" it would not.
TEST(Backprojection, HazardA32TheOwnSurfaceHides) {
  Roof roof;
  const auto complex = exact::build_complex(roof.scene.mesh(), &kStrip);
  ContourSegment s = segment_at_ten(complex);
  EXPECT_EQ(lowest_y(seen_by_segment(complex, s, kStrip, {})), FT(-4)) << "sheets at the edge itself are edge-on";
  // A lip at the far end of the lower sheet, up to y = 1: of the same mesh, and no more edge-on.
  roof.scene.quad({5, -0.25, -64}, {5, 1, -64}, {5, 1, 64}, {5, -0.25, 64});
  const auto with_lip = exact::build_complex(roof.scene.mesh(), &kStrip);
  const auto seen = seen_by_segment(with_lip, segment_at_ten(with_lip), kStrip, {});
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(highest_y(seen), FT(-1.25)) << "the plate hides more than the lip";
  Bounds bounds(roof.scene.mesh(), kStrip, {});
  refine_by_backprojection(bounds, {2, 0});
  EXPECT_EQ(contradictions(bounds.refined_map("backprojected"), 4, kSeed).total(), 0U);
}

TEST(Backprojection, RetractionGoesToTheNextEdge) {
  const Roof roof;
  const auto complex = exact::build_complex(roof.scene.mesh(), &kStrip);
  ContourSegment s = segment_at_ten(complex);
  const auto plane = adjusted_plane(s, seen_by_segment(complex, s, kStrip, {}), kStrip);
  ASSERT_TRUE(plane);
  EXPECT_FALSE(reference::runs_into_surface(complex, s.edge, s.plane));
  EXPECT_TRUE(reference::runs_into_surface(complex, s.edge, *plane)) << "between the two sheets of the roof";
  std::size_t steps = 0;
  const auto end = edge_between(complex, Point3(5, -0.25, -64), Point3(5, -0.25, 64));
  while (s.edge != end) {
    const auto next = reference::nearer_edge(complex, s, kStrip);
    ASSERT_TRUE(next);
    s = *next;
    ASSERT_LT(++steps, 4U);
  }
  EXPECT_FALSE(reference::nearer_edge(complex, s, kStrip)) << "no edge of the roof is nearer";

  double area[2];
  for (const bool retract : {false, true}) {
    Bounds bounds(roof.scene.mesh(), kStrip, {});
    area[retract] = refine_by_backprojection(bounds, {2, 0, retract}).back().area.upper;
    EXPECT_LT(area[retract], bounds.area().first_order);
    EXPECT_EQ(contradictions(bounds.refined_map("backprojected"), 4, kSeed).total(), 0U);
  }
  EXPECT_LE(area[1], area[0]);
}

}  // namespace
}  // namespace clues::test
