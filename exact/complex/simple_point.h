// Short rational points. Test points are chosen by us (definition, section 5), and an exact computation costs what its numbers are
// long: a point made by a chain of intersections has thousands of digits, one beside it has ten. These functions only
// propose; the caller decides exactly whether the proposal will do.
//
// The denominators are primes, so that a proposal is unlikely to fall on the lines of a scene drawn on a grid.
#pragma once

#include <array>
#include <optional>

#include "exact/kernel.h"

namespace clues::exact {

inline constexpr int kSimpleLevels = 4;  // finer and finer

// A short rational near x; x itself where the doubles end.
FT simple_near(const FT& x, int level);

// A short point of the open triangle abc (as an affine combination of its corners) near x, a point of its plane; none when
// rounding leaves the triangle.
std::optional<Point3> simple_in_triangle(const Point3& x, const std::array<Point3, 3>& corners, int level);

// A short point strictly between lo and hi on the segment from a to b, which contains both; lo is nearer to a.
Point3 simple_between(const Point3& a, const Point3& b, const Point3& lo, const Point3& hi);

}  // namespace clues::exact
