// The one-sided test of contact against CGAL's exact intersections, on grid triangles where every kind of contact occurs.
#include "fastpath/visibility/wedges/contact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <random>
#include <variant>

#include "exact/kernel.h"

namespace clues::tests {
namespace {

using exact::Point3;
using fastpath::Corners;
using Triangle3 = exact::Kernel::Triangle_3;
using Segment3 = exact::Kernel::Segment_3;

Triangle3 to_exact(const Corners& t) { return {exact::to_exact(t[0]), exact::to_exact(t[1]), exact::to_exact(t[2])}; }

// A point inside the convex intersection is inside t exactly when any point of it is.
struct InsidePoint {
  Point3 operator()(const Point3& p) const { return p; }
  Point3 operator()(const Segment3& s) const { return CGAL::midpoint(s.source(), s.target()); }
  Point3 operator()(const Triangle3& t) const { return CGAL::centroid(t); }
  Point3 operator()(const std::vector<Point3>& polygon) const {
    return CGAL::centroid(polygon[0], polygon[1], polygon[2]);
  }
};

bool meets_inside(const Corners& t, const Corners& other) {
  const Triangle3 a = to_exact(t);
  const auto common = CGAL::intersection(a, to_exact(other));
  if (!common) return false;
  const Point3 p = boost::apply_visitor(InsidePoint{}, *common);
  // In the plane of a; inside when on the same side of all edges, seen along the normal.
  const auto n = CGAL::normal(a[0], a[1], a[2]);
  for (int i = 0; i < 3; ++i) {
    if (CGAL::orientation(a[i], a[i + 1], a[i] + n, p) == CGAL::ZERO) return false;
  }
  return true;
}

TEST(Contact, NoIsAlwaysTrue) {
  std::mt19937 random(20261121);
  std::uniform_int_distribution<int> grid(0, 3);
  int inside = 0, apart = 0, unsure = 0;
  for (int i = 0; i < 20000; ++i) {
    Corners t{}, other{};
    for (Corners* corners : {&t, &other}) {
      for (auto& p : *corners) p = {double(grid(random)), double(grid(random)), double(grid(random) / 2)};
    }
    if (to_exact(t).is_degenerate() || to_exact(other).is_degenerate()) continue;
    const bool truth = meets_inside(t, other), answer = fastpath::may_meet_inside_conservative(t, other);
    ASSERT_TRUE(answer || !truth) << i;
    ++(truth ? inside : answer ? unsure : apart);
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(apart, 1000);
  EXPECT_EQ(unsure, 0);
}

TEST(Contact, NeighboursKeepAway) {
  const Corners t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  for (const Corners& other : {Corners{{{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}},         // beyond an edge, in the plane
                               Corners{{{4, 0, 0}, {0, 4, 0}, {2, 2, 3}}},         // folded up at an edge
                               Corners{{{0, 0, 0}, {-1, 0, 1}, {0, -1, -1}}},      // at a corner, across the plane
                               Corners{{{1, 0, 0}, {2, 0, 0}, {1, -3, 1}}},        // at a part of an edge
                               Corners{{{1, 1, 1}, {2, 1, 1}, {1, 2, 0.125}}}}) {  // above
    EXPECT_FALSE(fastpath::may_meet_inside_conservative(t, other));
  }
  // A wall that stands on a floor keeps away from it, but not the floor from the wall.
  const Corners wall{{{1, 1, 0}, {2, 1, 0}, {1, 1, 3}}};
  EXPECT_FALSE(fastpath::may_meet_inside_conservative(wall, t));
  EXPECT_TRUE(fastpath::may_meet_inside_conservative(t, wall));
}

}  // namespace
}  // namespace clues::tests
