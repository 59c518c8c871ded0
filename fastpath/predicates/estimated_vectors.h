// Vectors of doubles, rounded as they come: for estimates, and for choices that any plane would do for. Where more rests on
// them, the caller has a bound on the error.
#pragma once

#include "scene/mesh/mesh.h"

namespace clues::fastpath {

using scene::Point;

inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point cross_of(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot_of(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace clues::fastpath
