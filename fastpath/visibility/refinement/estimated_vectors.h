// Vectors of doubles, as rounded as they are: for choosing planes and for estimates of areas, on which no answer rests.
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
