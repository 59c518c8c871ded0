// More traps of the published text: those of sweeps, walks and of the traversal that hide visible geometry or never end. As in hazards_test.cpp the
// literal reading stands beside ours where it is short. docs/hazards.md lists which trap is tested where.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "exact/sight/scene_query.h"
#include "judges.h"
#include "reference/visibility/labels/walk.h"
#include "reference/visibility/search/fixpoint.h"
#include "reference/visibility/traversal/shaft.h"
#include "reference/visibility/traversal/traversal.h"
#include "reference/visibility/wedges/anticone.h"
#include "reference/visibility/wedges/contour.h"
#include "same_map.h"
#include "support.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Plane3;
using exact::Point3;
using exact::Vector3;
using reference::Formulation;
using reference::Meets;

constexpr bool kFront = true, kBack = false;

reference::VisibilityMap traversed(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  reference::Options options;
  options.formulation = Formulation::traversal;
  return map_of(mesh, cell, options);
}

// Both formulations, one map, and nothing hidden is seen.
void expect_right(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  const auto plain = map_of(mesh, cell), traversal = traversed(mesh, cell);
  EXPECT_EQ(region_lines(plain), region_lines(traversal));
  EXPECT_EQ(contradictions(plain, 10, 1).total(), 0U);
  EXPECT_EQ(plain.statistics.walk_disagreements + traversal.statistics.walk_disagreements, 0U);
}

// The first piece that an input triangle became.
std::uint32_t piece_of(const exact::Complex& complex, std::uint32_t triangle) {
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    for (const exact::Origin& o : complex.pieces[t].origins) {
      if (o.triangle == triangle) return t;
    }
  }
  throw std::logic_error("no such triangle");
}

std::array<Point3, 3> corners_of(const exact::Complex& complex, std::uint32_t t) {
  const auto& c = complex.pieces[t].corners;
  return {complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
}

// B-3: at the notch's corner FIG. 5C asks for the vertex order of the neighbouring supporting polygon and for a cell behind the swept triangle.
// That takes the far side of the cell's contour. The facet that is needed has the cell behind it the other way round.
TEST(Hazard, B3SweepAlongTheNearChain) {
  const auto cell = exact::ConvexCell::from_doubles({{2, 0, -4}, {-2, 0, -4}, {0, 2, -4}, {0, -2, -4}});
  const Point3 mv(0, 0, 0), start(0, 2, -4), near(2, 0, -4), far(-2, 0, -4);
  const auto literal_accepts = [&](const Point3& next) {
    return std::none_of(cell.vertices().begin(), cell.vertices().end(), [&](const Point3& v) {
      return Plane3(mv, start, next).oriented_side(v) == CGAL::ON_POSITIVE_SIDE;
    });
  };
  EXPECT_FALSE(literal_accepts(near));
  EXPECT_TRUE(literal_accepts(far));
  const auto facets = reference::anticone_facets(mv, cell);
  EXPECT_EQ(facets.size(), 4U);
  EXPECT_TRUE(std::any_of(facets.begin(), facets.end(),
                          [&](const auto& f) { return f.plane.has_on(start) && f.plane.has_on(near); }));
  for (const auto& f : facets) {
    for (const Point3& v : cell.vertices()) EXPECT_NE(f.plane.oriented_side(v), CGAL::ON_POSITIVE_SIDE);
  }
}

// B-4: FIG. 5A goes from cell vertex to cell vertex by the least angle to the polygon just made, which is nought for the edge it came along.
TEST(Hazard, B4TheSweepThatTurnsBackForEver) {
  const auto cell = box_cell(-1, -1, -6, 1, 1, -5);
  const Point3 mv(0.25, 0.125, 0);
  const auto facets = reference::anticone_facets(mv, cell);  // its silhouette edges, as reflected rays
  const auto neighbours = [&](const Vector3& ray) {
    std::vector<Vector3> out;
    for (const auto& f : facets) {
      if (f.ray0 == ray) out.push_back(f.ray1);
      if (f.ray1 == ray) out.push_back(f.ray0);
    }
    return out;
  };
  std::vector<Vector3> literal{facets[0].ray0, facets[0].ray1};
  while (literal.size() < 20) {
    const Vector3 &from = literal[literal.size() - 2], &at = literal.back();
    const Vector3 polygon = CGAL::cross_product(from, at);
    const auto turn = [&](const Vector3& next) {  // grows with the angle between the planes
      return CGAL::cross_product(polygon, CGAL::cross_product(next, at)).squared_length();
    };
    auto next = neighbours(at);
    literal.push_back(*std::min_element(next.begin(), next.end(), [&](auto& a, auto& b) { return turn(a) < turn(b); }));
  }
  EXPECT_EQ(literal[2], literal[0]);
  EXPECT_EQ(literal[19], literal[1]);
  // Ours: every silhouette edge once, no walk at all.
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(facets[i].ray0 == facets[j].ray0 && facets[i].ray1 == facets[j].ray1);
  }
  EXPECT_EQ(facets.size(), 4U);
}

// B-6: an axis-aligned reflex corner. Wedges bounded by the sides of the quadrangle and swept between the nearest vertices leave a gap beside the
// corner; a walk that leaves the plate there crosses no wedge.
TEST(Hazard, B6QuadranglesReachToTheirDiagonals) {
  SceneBuilder s;
  s.plate(-20, -20, 0, 20, 0);
  s.plate(0, -20, 20, 0, 0);
  const std::uint32_t receiver = s.plate(-3, -3, 3, 3, 1.625);
  const auto cell = box_cell(-2, -2, -4, 2, 2, -4);
  const auto map = map_of(s.mesh(), cell);
  const Point3 q(-0.3203125, -0.75, -4), tp(-0.30078125, -0.59375, 1.625);
  const exact::SceneQuery query(map.complex, map.cell);
  EXPECT_FALSE(query.crossings(q, tp).hits.empty());
  EXPECT_TRUE(query.is_free(Point3(1.9375, 1.9375, -4), tp));
  // Where q -> tp crosses the wedge plane z = -2y of the edge along +x: left of the corner's side ray (2,-2,4), right of its diagonal (-2,-2,4).
  const Plane3 plane(0, 2, 1, 0);
  const FT a = exact::value_at(plane, q), b = exact::value_at(plane, tp);
  const Point3 x = q + a / (a - b) * (tp - q);
  EXPECT_LT(x.x(), x.z() / FT(2));   // outside the literal wedge
  EXPECT_GT(x.x(), -x.z() / FT(2));  // inside ours
  EXPECT_TRUE(quad_visible(map, receiver, kBack, {-0.30078125, -0.59375, 1.625}));
  expect_right(s.mesh(), cell);
}

// B-11, B-30: a point of the figure-8 receiver, asked for while one of the two walls is still missing, is hidden. Such an answer must not be kept.
TEST(Hazard, B11AskedBeforeAllWallsExist) {
  SceneBuilder s;
  s.plate(-1, -10, 1, 10, 0);
  const std::uint32_t receiver = s.quad({-6, -8, 2}, {6, -8, 2}, {6, 8, 6}, {-6, 8, 6});
  const auto cell = box_cell(-2, -2, -4, 2, 2, -4);
  const exact::Complex complex = exact::build_complex(s.mesh(), &cell);
  const exact::SceneQuery scene(complex, cell);
  reference::Statistics unused;
  const reference::Options options;
  const auto all = reference::find_wedges(scene, options, unused).wedges;
  std::vector<reference::ValidPiece> left, rest;
  for (const auto& p : all.pieces())
    (p.wedge.near0.x() == FT(-1) && p.wedge.near1.x() == FT(-1) ? left : rest).push_back(p);
  ASSERT_FALSE(left.empty());
  reference::WedgeSet wedges(scene);
  wedges.add(left);
  const reference::Walker walker(scene);
  std::optional<reference::Start> start;
  for (const std::uint32_t triangle :
       {receiver, receiver + 1}) {  // just beside the left trace, beyond the crossing at Y = 0
    const std::uint32_t t = piece_of(complex, triangle);
    const auto c = corners_of(complex, t);
    const Point3 x(0.4375, 6, 5.5);
    if (exact::Kernel::Triangle_3(c[0], c[1], c[2]).has_on(x))
      start = reference::Start{x, reference::SurfaceSide{t, kBack}, nullptr};
  }
  ASSERT_TRUE(start);
  bool literal_hides = false;  // from some q of the cell the walk hits the plate and then crosses no wedge yet
  reference::Walk walk;
  for (std::uint64_t seed = 0; seed < 64 && !literal_hides; ++seed) {
    walk = walker.walk(*start, seed);
    literal_hides = walker.visible(*start, walk, wedges, 0) == Meets::no;
  }
  EXPECT_TRUE(literal_hides);
  const std::size_t later = wedges.pieces().size();
  wedges.add(rest);
  EXPECT_EQ(walker.visible(*start, walk, wedges, later), Meets::yes);  // looked at again, by the new pieces alone
}

// B-12: from the wedge's own cell vertex the segment to a point of the wedge lies in the wedge's plane, and a wedge through the point itself says
// nothing. Such segments are no answers; ours are chosen anew, and the two sides of a trace get different labels.
TEST(Hazard, B12SegmentsInSpecialPositionAreNoAnswer) {
  SceneBuilder s;
  s.plate(-1, -1, 1, 1, 0);
  const std::uint32_t receiver = s.plate(-4, -4, 4, 4, 1);
  const auto cell = box_cell(-0.5, -0.5, -2, 0.5, 0.5, -1);
  const auto map = map_of(s.mesh(), cell);
  const exact::SceneQuery query(map.complex, cell);
  reference::Statistics unused;
  const auto wedges = reference::find_wedges(query, {}, unused).wedges;
  const auto own = std::find_if(wedges.pieces().begin(), wedges.pieces().end(), [](const auto& p) {
    return !p.wedge.unbounded && p.wedge.near0.x() == FT(1) && p.wedge.near1.x() == FT(1);
  });
  ASSERT_NE(own, wedges.pieces().end());
  const Point3 on_trace = CGAL::midpoint(own->wedge.far0, own->wedge.far1);
  EXPECT_EQ(reference::crosses(*own, cell.center(), on_trace), Meets::degenerate);
  EXPECT_TRUE(query.crossings(own->wedge.center, on_trace).degenerate);
  const double x = CGAL::to_double(on_trace.x());
  EXPECT_FALSE(quad_visible(map, receiver, kBack, {x - 0.0625, 0.015625, 1}));
  EXPECT_TRUE(quad_visible(map, receiver, kBack, {x + 0.0625, 0.015625, 1}));
}

// B-15: seeds without a first-order edge, or whose umbra closes before it meets anything. The literal traversal spreads over the seed's mesh, finds no
// occlusion border to go on from, and ends.
TEST(Hazard, B15SeedsThatLeadNowhere) {
  const auto cell = box_cell(-5, -5, -5, 5, 5, 5);
  SceneBuilder needle;  // closed, every face has some of the cell before it
  const std::array<scene::Point, 4> p{{{6, -0.5, -0.5}, {6, 0.5, -0.5}, {6, 0, 0.5}, {105, 0, 0}}};
  needle.triangle(p[0], p[2], p[1]);
  needle.triangle(p[0], p[1], p[3]);
  needle.triangle(p[1], p[2], p[3]);
  needle.triangle(p[2], p[0], p[3]);
  SceneBuilder cube;
  cube.box({10, -0.5, -0.5}, {11, 0.5, 0.5});
  for (SceneBuilder* s : {&needle, &cube}) {
    const auto seeds = static_cast<std::uint32_t>(s->mesh().triangles.size());
    const std::uint32_t wall = s->quad({200, -300, -300}, {200, 300, -300}, {200, 300, 300}, {200, -300, 300});
    const auto plain = map_of(s->mesh(), cell);
    if (s == &needle) {  // no face is turned away from all of the cell: the published test finds no silhouette edge
      for (std::uint32_t t = 0; t < seeds; ++t) {
        const Plane3& plane = plain.complex.planes[piece_of(plain.complex, t)];
        EXPECT_TRUE(std::any_of(cell.vertices().begin(), cell.vertices().end(),
                                [&](const Point3& v) { return plane.oriented_side(v) == CGAL::ON_POSITIVE_SIDE; }));
      }
    } else {  // no wedge of the cube's borders an umbra on the wall
      EXPECT_TRUE(std::none_of(plain.segments.begin(), plain.segments.end(), [&](const auto& d) {
        return d.boundary && plain.complex.pieces[d.piece].origins[0].triangle >= wall;
      }));
    }
    const exact::SceneQuery whole(plain.complex, cell);
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      reference::Statistics statistics;
      const auto t = reference::traverse(whole, {}, statistics, {piece_of(plain.complex, seed)});
      EXPECT_TRUE(t.visited[piece_of(plain.complex, wall)]) << seed;
    }
    EXPECT_EQ(traversed(s->mesh(), cell).visible, plain.visible);
  }
}

// B-16: at a sharp corner the touching vertices of the two edges are opposite ones of the cell. Looking for the second among the neighbours of the
// first leaves part of the cell on the wrong side.
TEST(Hazard, B16TheNextTouchingVertexIsNotANeighbour) {
  const auto cell = exact::ConvexCell::from_doubles({{2, 0, -4}, {-2, 0, -4}, {0, 2, -4}, {0, -2, -4}});
  SceneBuilder s;
  s.triangle({0, 0, 0}, {20, 2, 0}, {20, -2, 0});
  s.plate(-30, -30, 30, 30, 4);
  const exact::Complex complex = exact::build_complex(s.mesh(), &cell);
  std::set<int> touching;
  for (const auto& c : reference::contour_edges(complex, cell)) {
    const exact::Edge& e = complex.edges[c.edge];
    const bool at_corner = complex.points[e.a] == Point3(0, 0, 0) || complex.points[e.b] == Point3(0, 0, 0);
    if (at_corner) touching.insert(c.touching.begin(), c.touching.end());
  }
  ASSERT_EQ(touching.size(), 2U);
  const std::array<int, 2> both{*touching.begin(), *touching.rbegin()};
  for (const auto& [i, j] : cell.edges()) EXPECT_FALSE(std::min(i, j) == both[0] && std::max(i, j) == both[1]);
  expect_right(s.mesh(), cell);
}

// B-18: what stands between the cell and the edge is no business of the wedge. The literal shaft reaches back to the cell vertex, meets the blocker, and leaves
// a hole in the wedge through which a walk gets out unseen.
TEST(Hazard, B18AWedgeBeginsAtItsEdge) {
  SceneBuilder s;
  s.quad({10, -5, 0}, {10, 5, 0}, {10, 5, 8}, {10, -5, 8});  // its edge z = 0 carries the wedge
  const std::uint32_t blocker = s.quad({5, -1, -2}, {5, 1, -2}, {5, 1, 2}, {5, -1, 2});
  s.quad({20, -30, -9}, {20, 30, -9}, {20, 30, 30}, {20, -30, 30});
  const auto cell = box_cell(-1, -0.5, 0, 0, 0.5, 2);
  const auto map = map_of(s.mesh(), cell);
  const exact::SceneQuery query(map.complex, cell);
  std::size_t across = 0;
  for (const auto& w : map.wedges) {
    if (w.kind == reference::WedgeKind::se_mv || w.near0.x() != FT(10) || w.near1.x() != FT(10)) continue;
    if (!CGAL::is_zero(w.near0.z()) || !CGAL::is_zero(w.near1.z())) continue;
    // The blocker stands in the supporting polygon of this piece.
    for (int k = 1; k < 16; ++k) {
      const Point3 y = w.near0 + FT(k) / 16 * (w.near1 - w.near0);
      across += !query.crossings(w.center, y, true).hits.empty();
    }
  }
  EXPECT_LT(blocker, map.complex.input_triangles);
  EXPECT_GT(across, 0U);
  expect_right(s.mesh(), cell);
}

// B-19: a plate whose plane cuts the cell has no edge that the published on-wedge walk stops at: it is walked around, and the wall behind it gets no
// trace. Ours is an envelope over all that meets the wedge.
TEST(Hazard, B19OnTheWedgeNothingIsWalkedAround) {
  SceneBuilder s;
  s.plate(-2, -9, 0, 9, 2);                                            // its edge x = 0 carries the wedge
  s.quad({-1.5, -1, 4}, {1.5, -1, 4.5}, {1.5, 1, 4.5}, {-1.5, 1, 4});  // faces the cell
  s.triangle({-2, 2, 3}, {-2, 2, 4}, {3, 2.0625, 3.5});                // nearly edge-on
  const std::uint32_t wall = s.plate(-20, -20, 20, 20, 8);
  const auto cell = box_cell(-1, -2, -1, 1, 3, 0);
  const auto map = map_of(s.mesh(), cell);
  std::set<std::uint32_t> ends;
  for (const auto& w : map.wedges) {
    if (w.kind == reference::WedgeKind::se_mv || !CGAL::is_zero(w.near0.x()) || !CGAL::is_zero(w.near1.x())) continue;
    if (!w.unbounded) ends.insert(map.complex.pieces[w.blocker].origins[0].triangle);
  }
  EXPECT_TRUE(ends.contains(wall) || ends.contains(wall + 1));
  EXPECT_TRUE(ends.contains(2) || ends.contains(3) || ends.contains(4));
  expect_right(s.mesh(), cell);
}

// B-21: step 20.4 leaves a triangle with an occlusion border at once, before its silhouette edges get their wedges. What is seen past them stays dark.
TEST(Hazard, B21ATriangleWithABorderKeepsItsEdges) {
  SceneBuilder s;
  s.plate(-1, -1, 1, 1, 1);
  const std::uint32_t middle = s.triangle({-4, -4, 3}, {6, -4, 3}, {0, 6, 3});
  const std::uint32_t wall = s.plate(-30, -30, 30, 30, 6);
  const auto cell = box_cell(-0.5, -0.5, -1, 0.5, 0.5, 0);
  const auto map = traversed(s.mesh(), cell);
  std::set<std::uint32_t> bordered;
  for (const auto& d : map.segments) {
    if (d.boundary) bordered.insert(map.complex.pieces[d.piece].origins[0].triangle);
  }
  EXPECT_TRUE(bordered.contains(middle));
  std::size_t from_middle = 0;
  for (const auto& w : map.wedges)
    from_middle += w.kind != reference::WedgeKind::se_mv && w.near0.z() == FT(3) && w.near1.z() == FT(3);
  EXPECT_GE(from_middle, 3U);
  EXPECT_TRUE(bordered.contains(wall) || bordered.contains(wall + 1));
  expect_right(s.mesh(), cell);
}

// B-24: CSVs make wedges that make CSVs. The chain ends: each is farther from the cell than the one before.
TEST(Hazard, B24ChainsOfCsvsEnd) {
  SceneBuilder s;
  for (int i = 0; i < 4; ++i) {
    const double z = 1.0 + i, turn = i % 2 ? 1 : -1;
    s.quad({-6, -0.75 * turn - 0.5, z}, {6, 0.75 * turn - 0.5, z}, {6, 0.75 * turn + 0.25, z + 0.25},
           {-6, -0.75 * turn + 0.25, z + 0.25});
  }
  s.plate(-20, -20, 20, 20, 8);
  const auto cell = box_cell(-0.25, -0.25, -1, 0.25, 0.25, -0.5);
  const auto map = map_of(s.mesh(), cell);
  EXPECT_GE(map.statistics.generations, 1);
  EXPECT_EQ(map.statistics.conservative_fallbacks, 0U);
  expect_right(s.mesh(), cell);
}

// B-28: if a surface that touches the shaft, or lies behind, counts as "untraversed in the shaft", two neighbours suspend each other for ever.
TEST(Hazard, B28NeighboursDoNotWaitForEachOther) {
  SceneBuilder s;
  s.box({3, -1, -1}, {4, 1, 1});
  s.box({4, -1, -1}, {5, 1, 1});  // touches the first
  const auto cell = box_cell(-1, -1, -1, 1, 1, 1);
  const exact::Complex complex = exact::build_complex(s.mesh(), &cell);
  std::size_t literal_pairs = 0, ours = 0;
  for (std::uint32_t i = 0; i < complex.pieces.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const auto a = corners_of(complex, i), b = corners_of(complex, j);
      const reference::Shaft of_a(a, cell), of_b(b, cell);
      const auto touches = [](const auto& x, const auto& y) {  // in a corner
        return std::any_of(x.begin(), x.end(),
                           [&](const Point3& p) { return std::find(y.begin(), y.end(), p) != y.end(); });
      };
      literal_pairs += touches(a, b);
      ours += touches(a, b) && of_a.is_entered_by(b) && of_b.is_entered_by(a);
    }
  }
  EXPECT_GT(literal_pairs, 0U);
  EXPECT_LT(ours, literal_pairs);
  const auto map = traversed(s.mesh(), cell);
  EXPECT_LE(map.statistics.passes, complex.pieces.size());
  expect_right(s.mesh(), cell);
}

// B-31: a mesh that the traversal has not met is judged by one of its vertices. Here the first vertex is in the umbra and the rest is not.
TEST(Hazard, B31OneVertexDoesNotSpeakForItsMesh) {
  SceneBuilder s;
  s.plate(-2, -2, 2, 2, 2);
  const std::uint32_t behind = s.triangle({0, 0, 4}, {9, 0.5, 4}, {9, -0.5, 4});
  const auto cell = box_cell(-0.5, -0.5, -1, 0.5, 0.5, 0);
  const auto map = traversed(s.mesh(), cell);
  const exact::SceneQuery query(map.complex, cell);
  reference::Statistics unused;
  const auto wedges = reference::find_wedges(query, {}, unused).wedges;
  const reference::Walker walker(query);
  EXPECT_FALSE(
      walker.label({Point3(0, 0, 3.9375), std::nullopt, nullptr}, wedges, {}, 1).visible);  // beside that vertex
  EXPECT_TRUE(is_visible(map, behind, kFront, {8.5, 0.0625, 4}));
  EXPECT_FALSE(is_visible(map, behind, kFront, {0.25, 0.0078125, 4}));
  expect_right(s.mesh(), cell);
}

}  // namespace
}  // namespace clues::test
