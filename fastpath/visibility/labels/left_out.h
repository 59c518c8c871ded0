// D17: what a limit left out. Wedges at a point x show nothing outside of the closed anti-cone A(x) (D8); so what keeps out of the A(x) of every x whose wedges are not there knows
// all that concerns it. The argument is in one_label.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fastpath/visibility/points/points.h"
#include "fastpath/visibility/wedges/apex.h"

namespace clues::fastpath {

// The closed side of a plane to which the normal points at the base, as enclosures.
struct HalfSpace {
  IntervalBox normal, base;
  Interval at(const IntervalBox& x) const { return dot(normal, x - base); }
};

class LeftOut {
 public:
  // Of a plane through `base` the side `sign` (1 or -1).
  struct Side {
    const Plane* plane = nullptr;
    int sign = 1;
    const ExactPoint* base = nullptr;
  };
  // What holds the A(x) of one x, or of all x of a convex set, as the sides around it; none if that is everything.
  using Around = std::vector<Side>;

  // The facets of A(x).
  static Around around(const Apex& apex);

  bool empty() const { return anticones_.empty(); }
  std::size_t size() const { return anticones_.size(); }
  void add(Around around);

  // Whether the hull of what the boxes enclose is surely outside of all. Needs RoundedUp in scope, here and below.
  bool surely_misses(std::span<const IntervalBox> hull) const;
  // Whether the segment from a to b is surely outside of number `i`; whether x is in it, exactly.
  bool surely_misses(std::size_t i, const IntervalBox& a, const IntervalBox& b) const;
  bool holds(std::size_t i, const ExactPoint& x) const;

 private:
  struct Anticone {
    Around around;
    std::vector<HalfSpace> sides;
  };
  std::vector<Anticone> anticones_;
};

}  // namespace clues::fastpath
