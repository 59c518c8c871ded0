// Vectors of intervals: what the checkers of motion enclose their numbers in. The rounding mode is the caller's (CGAL::Protect_FPU_rounding).
#pragma once

#include <CGAL/Interval_nt.h>

#include <array>

namespace clues::validate {

using Interval = CGAL::Interval_nt<false>;
using IntervalVector = std::array<Interval, 3>;

inline IntervalVector cross(const IntervalVector& a, const IntervalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Interval dot(const IntervalVector& a, const IntervalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace clues::validate
