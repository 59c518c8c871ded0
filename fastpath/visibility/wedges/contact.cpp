// Every `no` comes from a plane h with all of `other` in one closed half space and t in the other, t not in h as a whole: then t and `other` meet in h
// only, and t meets h in a corner or an edge.
#include "fastpath/visibility/wedges/contact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>

namespace clues::fastpath {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Exact signs with respect to the plane through three double points.
class PlaneSigns {
 public:
  PlaneSigns(const Point& a, const Point& b, const Point& c) : a_(at(a)), b_(at(b)), c_(at(c)) {}
  int operator()(const Point& p) const { return static_cast<int>(CGAL::orientation(a_, b_, c_, at(p))); }

 private:
  static Kernel::Point_3 at(const Point& p) { return {p[0], p[1], p[2]}; }
  Kernel::Point_3 a_, b_, c_;
};

struct Sides {
  bool negative = false, positive = false;
};

Sides sides(const PlaneSigns& plane, const Corners& t) {
  Sides out;
  for (const Point& p : t) {
    const int sign = plane(p);
    out.negative = out.negative || sign < 0;
    out.positive = out.positive || sign > 0;
  }
  return out;
}

// t and `other` on different closed sides, and t not in the plane.
bool separates(const PlaneSigns& plane, const Corners& t, const Corners& other) {
  const Sides of_t = sides(plane, t);
  if (of_t.negative == of_t.positive) return false;
  const Sides of_other = sides(plane, other);
  return of_t.negative ? !of_other.negative : !of_other.positive;
}

// The plane of `other` itself: t on one closed side of it and not in it.
bool on_one_side_of(const Corners& other, const Corners& t) {
  const Sides of_t = sides(PlaneSigns(other[0], other[1], other[2]), t);
  return of_t.negative != of_t.positive;
}

}  // namespace

bool may_meet_inside_conservative(const Corners& t, const Corners& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax({t[0][i], t[1][i], t[2][i]});
    const auto [other_low, other_high] = std::minmax({other[0][i], other[1][i], other[2][i]});
    if (high < other_low || other_high < low) return false;
  }
  if (on_one_side_of(other, t)) return false;
  const PlaneSigns plane(t[0], t[1], t[2]);
  const Sides of_other = sides(plane, other);
  if (of_other.negative != of_other.positive &&
      std::none_of(other.begin(), other.end(), [&](const Point& p) { return plane(p) == 0; })) {
    return false;
  }
  // Planes through an edge of t and a corner of `other`, or the other way round; and, for triangles in one plane, through an edge and a point off it.
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3], &c = other[i], &d = other[(i + 1) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (separates({a, b, other[k]}, t, other) || separates({c, d, t[k]}, t, other)) return false;
      Point off_a = a, off_c = c;
      off_a[k] += 1;
      off_c[k] += 1;
      if (separates({a, b, off_a}, t, other) || separates({c, d, off_c}, t, other)) return false;
    }
  }
  return true;
}

bool in_plane_of(const Corners& t, const Corners& other) {
  const PlaneSigns plane(t[0], t[1], t[2]);
  return std::all_of(other.begin(), other.end(), [&](const Point& p) { return plane(p) == 0; });
}

int side_of_plane(const Corners& t, const Point& p) { return PlaneSigns(t[0], t[1], t[2])(p); }

}  // namespace clues::fastpath
