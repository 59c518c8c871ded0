// Literal readings of the published text about backprojection (LIST (a) of its restatement), worked out exactly: each hides what a sight line sees. That nothing of the kind happens here is shown in
// refinement_hazards_test.cpp; docs/hazards.md has the whole list.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "exact/sight/witness.h"
#include "reference/visibility/refinement/deviation.h"
#include "reference/visibility/search/fixpoint.h"
#include "strip_scenes.h"

namespace clues::test {
namespace {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::ContourSegment;

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

// What the entire edge sees is what the upper half sees: y <= -1.
TEST(Backprojection, HazardA30WhatTheEntireEdgeSeesIsTooLittle) {
  const PostBeforeHalf it;
  ContourSegment upper = it.s;
  upper.lo = Point3(10, 0, 32);
  EXPECT_EQ(highest_y(seen_by_segment(it.complex, upper, kStrip, {})), FT(-1));
  EXPECT_EQ(highest_y(seen_by_segment(it.complex, it.s, kStrip, {})), FT(0));
  expect_hides_what_is_seen(it.scene, kStrip, it.adjusted_to_minus_one, Point3(0, -4, 0), it.q, it.p);
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
