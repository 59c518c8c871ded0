// Hazards of the published text about backprojection (LIST (a) of its restatement): what a literal reading does, and that nothing of the kind happens here.
// A-4 is in refinement_test.cpp; docs/hazards.md has the whole list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "exact/cell_cut.h"
#include "exact/point_occlusion.h"
#include "exact/scene_query.h"
#include "exact/witness.h"
#include "fuzz/generators/skew_edges.h"
#include "judges.h"
#include "reference/visibility/backprojection.h"
#include "reference/visibility/bounds.h"
#include "reference/visibility/deviation.h"
#include "reference/visibility/fixpoint.h"
#include "reference/visibility/retraction.h"

namespace clues::test {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::Bounds;
using reference::ContourSegment;

constexpr std::uint64_t kSeed = 20261121;

std::vector<bool> all_sides(const exact::Complex& complex) {
  return std::vector<bool>(2 * complex.pieces.size(), true);
}

std::uint32_t edge_between(const exact::Complex& complex, const Point3& a, const Point3& b) {
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const Point3 &p = complex.points[complex.edges[e].a], &q = complex.points[complex.edges[e].b];
    if ((p == a && q == b) || (p == b && q == a)) return e;
  }
  throw std::runtime_error("no such edge");
}

// The strip x = 0, -4 <= y <= 0 as cell; a plate that ends in the edge x = 10, y = 0.
const ConvexCell kStrip = ConvexCell::from_doubles({{0, -4, -1}, {0, 0, -1}, {0, 0, 1}, {0, -4, 1}});
SceneBuilder plate_below() {
  SceneBuilder scene;
  scene.quad({10, -50, -64}, {10, 0, -64}, {10, 0, 64}, {10, -50, 64});
  return scene;
}
ContourSegment segment_at_ten(const exact::Complex& complex) {
  const Point3 lo(10, 0, -64), hi(10, 0, 64);
  return {edge_between(complex, lo, hi), lo, hi, Plane3(0, 1, 0, 0), Point3(0, 0, -1)};
}

FT lowest_y(const std::vector<Point3>& points) {
  return std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); })
      ->y();
}
FT highest_y(const std::vector<Point3>& points) {
  return std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); })
      ->y();
}

// q, in the cell, sees p over the segment; a wedge in this plane, which has the rest of the cell on the side of `kept`, says that p is hidden behind the plate.
void expect_hides_what_is_seen(const SceneBuilder& scene, const ConvexCell& cell, const Plane3& plane,
                               const Point3& kept, const Point3& q, const Point3& p) {
  const auto line = exact::check_sight_line(scene.mesh(), cell, q, p);
  EXPECT_TRUE(line.valid);
  EXPECT_TRUE(line.blockers.empty());
  const auto hidden_side = plane.oriented_side(kept);
  EXPECT_NE(hidden_side, CGAL::ON_ORIENTED_BOUNDARY);
  EXPECT_EQ(plane.oriented_side(p), hidden_side);
}

// The point on the line from q through e, a fifth further on.
Point3 beyond(const Point3& q, const Point3& e) { return q + FT(6) / 5 * (e - q); }

Point3 where_passed(const Plane3& plane, const Point3& from, const Point3& to) {
  const auto value = [&](const Point3& x) {
    return plane.a() * x.x() + plane.b() * x.y() + plane.c() * x.z() + plane.d();
  };
  return from + value(from) / (value(from) - value(to)) * (to - from);
}

// FIG. 25 from q to p, a point of the scene's last triangle: does the last surface on the way let the walk out again, by a first-order wedge that is not left out?
template <class LeftOut>
reference::Meets lets_out(const exact::Complex& complex, const ConvexCell& cell, const Point3& q, const Point3& p,
                          const LeftOut& left_out) {
  const exact::SceneQuery query(complex, cell);
  const auto hits = query.crossings(q, p).hits;
  if (hits.empty()) throw std::runtime_error("the walk meets nothing");
  reference::Statistics unused;
  const reference::Options defaults;
  return find_wedges(query, defaults, unused).wedges.crossed(q + hits.back().t * (p - q), p, 0, left_out);
}
constexpr auto kNone = [](const reference::ValidPiece&) { return false; };
auto through(const Point3& a, const Point3& b) {
  return [a, b](const reference::ValidPiece& x) { return x.wedge.plane.has_on(a) && x.wedge.plane.has_on(b); };
}

// For questions in which only the ends matter.
ContourSegment segment(const Point3& lo, const Point3& hi) { return {0, lo, hi, Plane3(0, 1, 0, 0), lo}; }

bool hidden_from(const ContourSegment& s, const Point3& p, const SceneBuilder& scene) {
  std::vector<exact::TriangleCorners> corners;
  for (const auto& t : scene.mesh().triangles) {
    exact::TriangleCorners c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = exact::to_exact(scene.mesh().points[t[i]]);
    corners.push_back(c);
  }
  return exact::point_occlusion(p, std::nullopt, ConvexCell(std::vector<Point3>{s.lo, s.hi}), corners).occluded;
}

// Upon V the shadow of a bar is narrow at one end and closes in a crossing of its two borders; beyond, all is seen. Both borders are OB segments before the crossing. Copied across
// it, that status encloses the far end of V, and the wedge is adjusted to what lies beside.
TEST(Backprojection, HazardA5AStatusCopiedAcrossACrossingClosesOffWhatIsSeen) {
  const ConvexCell cell = ConvexCell::from_doubles({{3, 0, -1}, {3, 0, 1}, {5.5, -4, 1}, {5.5, -4, -1}});
  SceneBuilder scene;
  scene.quad({10, -50, -4}, {10, 0, -4}, {10, 0, 4}, {10, -50, 4});
  scene.quad({6, -8, -1}, {6, 8, -1}, {6, 8, 1}, {6, -8, 1});
  const ContourSegment s = segment(Point3(10, 0, -4), Point3(10, 0, 4));
  const Plane3 upper(Point3(10, 0, 4), Point3(6, 0, 1), Point3(6, 1, 1));
  const Plane3 lower(Point3(10, 0, -4), Point3(6, 0, -1), Point3(6, 1, -1));
  const Point3 crossing(FT(14) / 3, FT(-8) / 3, 0), before(5, FT(-16) / 5, 0), behind(FT(25) / 8, FT(-1) / 5, 0);
  EXPECT_TRUE(upper.has_on(crossing) && lower.has_on(crossing));
  for (const auto& border : {upper, lower}) EXPECT_NE(border.oriented_side(before), border.oriented_side(behind));
  EXPECT_TRUE(hidden_from(s, before, scene));
  EXPECT_FALSE(hidden_from(s, behind, scene));
  // The highest point of V that is not closed off: where the upper border leaves V.
  const Point3 touched(FT(10) / 3, FT(-8) / 15, -1);
  EXPECT_TRUE(upper.has_on(touched));
  expect_hides_what_is_seen(scene, cell, Plane3(s.lo, s.hi, touched), before, behind,
                            beyond(behind, Point3(10, 0.015625, 3.75)));
  EXPECT_EQ(highest_y(seen_by_segment(exact::build_complex(scene.mesh(), &cell), s, cell, {})), FT(0));
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

// A post before the upper half of the edge hides y > -1 from it. The lower half sees all of the cell.
struct PostBeforeHalf {
  SceneBuilder scene = plate_below();
  std::uint32_t post = scene.quad({5, -0.5, 0}, {5, 3, 0}, {5, 3, 64}, {5, -0.5, 64});
  exact::Complex complex = exact::build_complex(scene.mesh(), &kStrip);
  ContourSegment s = segment_at_ten(complex);
  Point3 q{0, -0.125, 0.5}, p = beyond(q, Point3(10, 0.015625, -16));
  Plane3 adjusted_to_minus_one{s.lo, s.hi, Point3(0, -1, 0)};
};

// By the printed rule a silhouette edge has two triangles, and the post has none: from the upper end of the edge a walk enters it and nothing lets it out.
TEST(Backprojection, HazardA7WithoutWallsAtBordersTheShadowHasNoEnd) {
  const PostBeforeHalf it;
  std::size_t printed = 0;
  for (const auto& e : it.complex.edges) {
    if (e.pieces.size() != 2) continue;
    bool all_back[2] = {true, true};
    for (std::size_t i = 0; i < 2; ++i) {
      for (const Point3& end : {it.s.lo, it.s.hi})
        all_back[i] &= it.complex.planes[e.pieces[i]].oriented_side(end) != CGAL::ON_POSITIVE_SIDE;
    }
    printed += all_back[0] != all_back[1];
  }
  EXPECT_EQ(printed, 0U);
  const ConvexCell source(std::vector<Point3>{it.s.lo, it.s.hi});
  EXPECT_FALSE(exact::check_sight_line(it.scene.mesh(), source, Point3(10, 0, 16), it.q).blockers.empty());
  EXPECT_TRUE(
      exact::check_sight_line(it.scene.mesh(), source, Point3(10, 0, 16), Point3(0, -1.125, 0.5)).blockers.empty());
  EXPECT_FALSE(hidden_from(it.s, it.q, it.scene)) << "the lower half sees it";
  expect_hides_what_is_seen(it.scene, kStrip, it.adjusted_to_minus_one, Point3(0, -4, 0), it.q, it.p);
}

// What two edges of a notch see of V through a window, and the corner between them. The one contour contains the other: literally the swept wedge stands on the chord of the two
// touched points. The window bulges beyond it.
TEST(Backprojection, HazardA8TheChordCutsOffWhatTheCornerSees) {
  SceneBuilder scene;
  scene.plate(-20, -20, 0, 20, 0);
  scene.plate(0, -20, 20, 0, 0);
  const std::vector<std::array<double, 2>> hole{{1, -0.25}, {1, 0.25},     {0.75, 0.75}, {0.25, 1},
                                                {-0.25, 1}, {-0.75, 0.75}, {-1, 0.25},   {-1, -0.25}};
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const auto &a = hole[i], &b = hole[(i + 1) % hole.size()];
    scene.quad({a[0], a[1], -2}, {b[0], b[1], -2}, {64 * b[0], 64 * b[1], -2}, {64 * a[0], 64 * a[1], -2});
  }
  const ConvexCell cell = ConvexCell::from_doubles({{-32, 0, -4}, {8, 0, -4}, {8, 8, -4}, {-32, 8, -4}});
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 corner(0, 0, 0), up(0, 20, 0), right(20, 0, 0);
  const auto seen_up = seen_by_segment(complex, segment(corner, up), cell, {});
  const auto seen_right = seen_by_segment(complex, segment(corner, right), cell, {});
  const ConvexCell hull_up(seen_up), hull_right(seen_right);
  for (const Point3& x : hull_up.vertices()) EXPECT_TRUE(hull_right.contains(x));
  const Point3 touched_up(2, 0.5, -4), touched_right(0.5, 2, -4), q(1.4375, 1.4375, -4);
  for (const Point3& x : hull_up.vertices()) EXPECT_LE(x.x(), touched_up.x());
  for (const Point3& x : hull_right.vertices()) EXPECT_LE(x.y(), touched_right.y());
  EXPECT_TRUE(hull_up.contains(touched_up) && hull_right.contains(touched_right));
  EXPECT_TRUE(cell.interior_contains(touched_up) && cell.interior_contains(touched_right)) << "no edges of V";
  expect_hides_what_is_seen(scene, cell, Plane3(corner, touched_up, touched_right), Point3(0, 0.5, -4), q,
                            Point3(-1.375, -1.375, 4));
}

// The line through the edge meets the plane of the cell's front at z = -16, and so does what bounds the part that the edge sees. A cut parallel to the edge, as an SE-ME wedge would
// make, drops some of that part; the swept wedge at the notch, along the cut, hides what it shows.
TEST(Backprojection, HazardA9ACutParallelToTheEdgeDropsWhatItSees) {
  const ConvexCell cell = box_cell(-1, -4, -4, 0, 0, 4);
  SceneBuilder scene;
  scene.quad({8, -64, -8}, {24, -64, 8}, {24, 0, 8}, {8, 0, -8});
  scene.quad({24, -64, 8}, {40, -64, 24}, {40, 64, 24}, {24, 64, 8});
  scene.quad({4, -0.3125, -8}, {4, -1.25, 8}, {4, 2, 8}, {4, 2, -8});
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 lo(8, 0, -8), notch(24, 0, 8);
  const ContourSegment s{edge_between(complex, lo, notch), lo, notch, Plane3(0, 1, 0, 0), Point3(0, 0, 0)};
  const auto seen = seen_by_segment(complex, s, cell, {});
  const auto plane = adjusted_plane(s, seen, cell);
  ASSERT_TRUE(plane);
  std::vector<Point3> touched;
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(touched), [&](const auto& x) { return plane->has_on(x); });
  ASSERT_FALSE(touched.empty());
  const FT cut = highest_y(touched);
  for (const Point3& x : touched) EXPECT_EQ(x.z(), FT(4));
  EXPECT_GT(highest_y(seen), cut) << "seen, and above the cut";
  const Plane3 literal(notch, Point3(0, cut, 4), Point3(0, cut, -4));
  const Point3 q(-0.015625, -0.875, -3.5);
  EXPECT_FALSE(hidden_from(s, q, scene));
  expect_hides_what_is_seen(scene, cell, literal, Point3(0, -4, 0), q, beyond(q, Point3(23.75, 0.015625, 7.75)));
}

// What a segment sees is an L. "Any convex simplification" is not enough: without its two highest corners it is convex, too.
TEST(Backprojection, HazardA10AConvexSimplificationFromWithinHides) {
  SceneBuilder scene;
  scene.quad({10, -50, -0.25}, {10, 0, -0.25}, {10, 0, 0.25}, {10, -50, 0.25});
  scene.quad({5, -0.5, 0.125}, {5, 3, 0.125}, {5, 3, 4}, {5, -0.5, 4});
  const auto complex = exact::build_complex(scene.mesh(), &kStrip);
  const Point3 lo(10, 0, -0.25), hi(10, 0, 0.25);
  const ContourSegment s{edge_between(complex, lo, hi), lo, hi, Plane3(0, 1, 0, 0), Point3(0, 0, 0)};
  auto seen = seen_by_segment(complex, s, kStrip, {});
  EXPECT_EQ(highest_y(seen), FT(0));
  EXPECT_TRUE(hidden_from(s, Point3(0, -0.5, 0.75), scene)) << "not convex";
  seen.erase(std::remove_if(seen.begin(), seen.end(), [](const Point3& x) { return x.y() > -1; }), seen.end());
  EXPECT_EQ(highest_y(seen), FT(-1));
  const Point3 q(0, -0.125, -0.5);
  expect_hides_what_is_seen(scene, kStrip, Plane3(lo, hi, Point3(0, -1, 0)), Point3(0, -4, 0), q,
                            beyond(q, Point3(10, 0.015625, 0)));
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

// Walls at x = constant, between each two of the heights.
void wall(SceneBuilder& scene, double x, const std::vector<double>& y) {
  for (std::size_t i = 0; i < y.size(); i += 2)
    scene.quad({x, y[i], -32}, {x, y[i + 1], -32}, {x, y[i + 1], 32}, {x, y[i], 32});
}

// Two slits let a thin sheet of light through, beside the edge. The text does not say what becomes of a wedge without VSVV. Dropped, no wall lets a walk out that went through the plate.
TEST(Backprojection, HazardA11WithoutItsWedgeTheShadowOfThePlateIsOpen) {
  SceneBuilder scene;
  for (const double x : {4.0, 8.0}) wall(scene, x, {-16, -0.0625, 0.0625, 16});
  scene.quad({10, 0.5, -8}, {10, 8, -8}, {10, 8, 8}, {10, 0.5, 8});
  scene.triangle({20, -1, -1}, {20, 1, 0}, {20, -1, 1});
  const ConvexCell cell = box_cell(-1, -4, -1, 0, 4, 1);
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 lo(10, 0.5, -8), hi(10, 0.5, 8), q(-0.25, 2, 0.25), p(20, 0, 0.125);
  EXPECT_TRUE(seen_by_segment(complex, segment(lo, hi), cell, {}).empty());
  const auto line = exact::check_sight_line(scene.mesh(), cell, Point3(-0.5, 0, 0), p);
  EXPECT_TRUE(line.valid && line.blockers.empty());
  EXPECT_EQ(lets_out(complex, cell, q, p, kNone), reference::Meets::yes);
  EXPECT_EQ(lets_out(complex, cell, q, p, through(lo, hi)), reference::Meets::no);
}

// At a notch both edges have the same angle between supporting and separating plane. A bar hides the supporting vertex (1, 0) from one of them. Read "adjust" there and "keep" at the
// swept wedge, a threshold of that angle leaves a gap between the two.
TEST(Backprojection, HazardA29BesideAnAdjustedWedgeTheSweptOneMustBeAdjusted) {
  SceneBuilder scene;
  scene.plate(-20, -20, 0, 20, 0);
  scene.plate(0, -20, 20, 0, 0);
  scene.quad({0.859375, -1, -3.875}, {1, -1, -3.875}, {1, 2, -3.875}, {0.84375, 2, -3.875});
  scene.triangle({-0.84375, 0.125, 4}, {-0.8125, 0.1875, 4}, {-0.78125, 0.125, 4});
  const ConvexCell cell = ConvexCell::from_doubles({{1, 0, -4},
                                                    {0.75, 0.75, -4},
                                                    {0, 1, -4},
                                                    {-0.75, 0.75, -4},
                                                    {-1, 0, -4},
                                                    {-0.75, -0.75, -4},
                                                    {0, -1, -4},
                                                    {0.75, -0.75, -4},
                                                    {0, 0, -4.25}});
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 notch(0, 0, 0), up(0, 20, 0), p(-0.8125, 0.140625, 4), q(0.828125, -0.109375, -4 - 0.015625);
  const ContourSegment s{edge_between(complex, notch, up), notch, up, Plane3(1, 0, FT(1) / 4, 0), Point3(1, 0, -4)};
  const auto seen = seen_by_segment(complex, s, cell, {});
  Point3 touched = seen.at(0);
  for (const Point3& x : seen) touched = x.x() * touched.z() < touched.x() * x.z() ? x : touched;
  EXPECT_LT(touched.y(), -FT(1) / 4) << "not on the original chain from (1,0) to (0,1)";
  const auto line = exact::check_sight_line(scene.mesh(), cell, q, p);
  EXPECT_TRUE(line.valid && line.blockers.empty());

  // The walk passes the adjusted wedge's plane where no ray from the touched point over the edge arrives. No sweep begins at the original chain's other side, either.
  const Plane3 adjusted(notch, up, touched);
  EXPECT_NE(adjusted.oriented_side(p), adjusted.oriented_side(q)) << "seen past the adjusted wedge";
  const Point3 from(0.25, 0.25, -4.0625);
  const auto ray = where_passed(adjusted, from, p) - touched;
  EXPECT_LT(touched.y() - touched.z() / ray.z() * ray.y(), FT(0));
  const auto left_out = [&](const reference::ValidPiece& x) {
    return through(notch, up)(x) ||
           (through(notch, Point3(1, 0, -4))(x) && x.wedge.plane.has_on(Point3(0.75, -0.75, -4)));
  };
  EXPECT_EQ(lets_out(complex, cell, from, p, kNone), reference::Meets::yes);
  EXPECT_EQ(lets_out(complex, cell, from, p, left_out), reference::Meets::no);
}

// A slanted plate: one half of the edge sees y < -0.9375, the other y < -1.4375. Both have the same original supporting vertices: no part of the original chain lies between theirs, and
// nothing joins the two adjusted wedges.
TEST(Backprojection, HazardA31WhereNothingJoinsTwoHalvesAWalkSlipsThrough) {
  SceneBuilder scene;
  scene.quad({8, -16, -8}, {8, 0, -8}, {8, 0, 8}, {8, -16, 8});
  scene.quad({4, -0.25, -8}, {4, -1.25, 8}, {4, 2, 8}, {4, 2, -8});
  scene.triangle({16, 1.515625, 0.84375}, {16, 1.546875, 0.84375}, {16, 1.53125, 0.90625});
  const ConvexCell cell = box_cell(-1, -4, -1, 0, 0, 1);
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 lo(8, 0, -8), joint(8, 0, 0), hi(8, 0, 8);
  const Point3 touched_low(0, -0.9375, -1), touched_high(0, -1.4375, -1);
  EXPECT_EQ(highest_y(seen_by_segment(complex, segment(lo, joint), cell, {})), touched_low.y());
  EXPECT_EQ(highest_y(seen_by_segment(complex, segment(joint, hi), cell, {})), touched_high.y());

  // A walk passes the plane of each half beyond the end of its wedge, which is the ray from z = -1 over the joint.
  const Point3 from(-0.0625, -3, 0), p(16, 1.53125, 0.875), q(-0.015625, -1.5, -0.84375);
  const Point3 low = where_passed(Plane3(lo, hi, touched_low), from, p);
  const Point3 high = where_passed(Plane3(lo, hi, touched_high), from, p);
  EXPECT_GT(8 * low.z(), low.x() - 8);
  EXPECT_LT(8 * high.z(), high.x() - 8);
  EXPECT_EQ(lets_out(complex, cell, from, p, kNone), reference::Meets::yes);
  EXPECT_EQ(lets_out(complex, cell, from, p, through(lo, hi)), reference::Meets::no);
  const auto line = exact::check_sight_line(scene.mesh(), cell, q, p);
  EXPECT_TRUE(line.valid && line.blockers.empty());
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

// What the entire edge sees is what the upper half sees: y <= -1.
TEST(Backprojection, HazardA30WhatTheEntireEdgeSeesIsTooLittle) {
  const PostBeforeHalf it;
  ContourSegment upper = it.s;
  upper.lo = Point3(10, 0, 32);
  EXPECT_EQ(highest_y(seen_by_segment(it.complex, upper, kStrip, {})), FT(-1));
  EXPECT_EQ(highest_y(seen_by_segment(it.complex, it.s, kStrip, {})), FT(0));
  expect_hides_what_is_seen(it.scene, kStrip, it.adjusted_to_minus_one, Point3(0, -4, 0), it.q, it.p);
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

// The edge, with a shelf towards the cell, sees the cell from above the shelf only: the adjusted wedge arrives in the corner of its own mesh and is no wall. The light on the axis is
// seen all the same, and a walk through the plate is not let out.
TEST(Backprojection, HazardA32AWedgeThatArrivesInItsOwnMeshIsNoWall) {
  SceneBuilder scene;
  wall(scene, 4, {-16, -0.0625, 0.0625, 1.9375, 2.0625, 16});
  wall(scene, 8, {-16, -0.0625, 0.0625, 0.9375, 1.0625, 16});
  const auto own = scene.quad({10, 0.5, -8}, {10, 8, -8}, {10, 8, 8}, {10, 0.5, 8});
  scene.quad({10, 0.5, -8}, {10, 0.5, 8}, {9, 0.625, 8}, {9, 0.625, -8});
  scene.triangle({20, -1, -1}, {20, 1, 0}, {20, -1, 1});
  const ConvexCell cell = box_cell(-1, -4, -1, 0, 4, 1);
  const auto complex = exact::build_complex(scene.mesh(), &cell);
  const Point3 lo(10, 0.5, -8), hi(10, 0.5, 8), q(-0.25, 2, 0.25), p(20, 0, 0.125);
  ContourSegment s{edge_between(complex, lo, hi), lo, hi, Plane3(lo, Point3(0, -4, -1), hi), Point3(0, -4, -1)};
  if (s.plane.has_on_positive_side(Point3(0, 0, 0))) s.plane = s.plane.opposite();
  const auto seen = seen_by_segment(complex, s, cell, {});
  ASSERT_FALSE(seen.empty());
  EXPECT_GT(lowest_y(seen), FT(2));
  const auto plane = adjusted_plane(s, seen, cell);
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->oriented_side(Point3(9, 0.625, 0)) != plane->oriented_side(Point3(10, 8, 0)));
  // From what the edge sees, a line past it hits the mesh on either side of it.
  for (const double y : {0.5 + 0.0078125, 0.5 - 0.0078125}) {
    const Point3 v(-0.015625, 3, 0);
    const auto blockers = exact::check_sight_line(scene.mesh(), cell, v, beyond(v, Point3(10, y, 0))).blockers;
    ASSERT_FALSE(blockers.empty());
    EXPECT_GE(blockers.front(), own);
  }
  EXPECT_TRUE(exact::check_sight_line(scene.mesh(), cell, Point3(-0.5, 0, 0), p).blockers.empty());
  EXPECT_EQ(lets_out(complex, cell, q, p, kNone), reference::Meets::yes);
  EXPECT_EQ(lets_out(complex, cell, q, p, through(lo, hi)), reference::Meets::no);
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

// From an edge the cell is seen through two slits. The wedges of the nearer slit meet the farther wall, and the text jumps there in the middle of them. Where those that wait are lost,
// a walk that went through the nearer wall is not let out.
TEST(Backprojection, HazardA33WithoutTheWedgesThatWaitedTheEdgeSeesLess) {
  SceneBuilder scene;
  scene.quad({2, -8, -8}, {2, -0.25, -8}, {2, -0.25, 8}, {2, -8, 8});
  scene.quad({2, 0.25, -8}, {2, 8, -8}, {2, 8, 8}, {2, 0.25, 8});
  scene.quad({4, -8, -8}, {4, 8, -8}, {4, 8, -0.25}, {4, -8, -0.25});
  scene.quad({4, -8, 0.25}, {4, 8, 0.25}, {4, 8, 8}, {4, -8, 8});
  scene.triangle({0, -1, -1}, {0, 1, 0}, {0, -1, 1});
  const ConvexCell source(std::vector<Point3>{Point3(6, 0, -8), Point3(6, 0, 8)});
  const auto complex = exact::build_complex(scene.mesh(), &source);
  const Point3 from(6, 0, -4), x(0, -0.125, 0.125);
  EXPECT_EQ(lets_out(complex, source, from, x, kNone), reference::Meets::yes);
  EXPECT_EQ(lets_out(complex, source, from, x, through(Point3(4, -8, -0.25), Point3(4, 8, -0.25))),
            reference::Meets::no);
  EXPECT_TRUE(exact::check_sight_line(scene.mesh(), source, Point3(6, 0, 0), x).blockers.empty());
}

}  // namespace
}  // namespace clues::test
