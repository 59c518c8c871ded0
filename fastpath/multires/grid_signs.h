// Signs of D32 and D33 where 64 bits do not hold the numbers: in doubles with a derived error bound first, in whole numbers of 128 bits
// (exact/multires/grid.h) where that does not tell. Signs of three ring vertices (51 bits) and of weights (61 bits, one product of 128) are taken
// from whole numbers at once: on today's machines that is a multiplication or two, and no filter is faster.
//
// ---- Error bounds. u = 2^-53. Doubles are in units of the disk, so that coordinates are at most 1: ring vertices are multiples of 2^-24, exact,
// and so are their sums, differences and threefolds.
//
// A point of the star is f = sum c w, with corners c (at most three, one of which may be 0, the middle) and weights w over 2^60 that sum to 1. A
// weight is rounded (u), its product (u), and two sums (2u): |error of f| <= e = (1+u)^4 - 1 for each coordinate, and |f| <= 1.
//
// side(a, b, f) = (b-a)x (f-a)y - (b-a)y (f-a)x. (b-a) is exact, at most 2. f - a: at most 2 + e, rounded: error d = e + u (2 + e). A product: at most
// 2 (2 + d), error 2 d, rounded: p = 2 d + u (4 + 2 d). The difference of two: at most 8 + 2 p, rounded: 2 p + u (8 + 2 p), below 40.1 u.
//
// middle(a, b, s) is the same with s = f + g + h for f and 3a for a, which is three times what the mean of three points has: sums of at most
// 2 + 2e and 3 + 3e + ... are rounded, |error of s| <= m = 3 e + u (2 + 2 e) + u (3 + 3 e + u (2 + 2 e)); s - 3a is at most 6, d = m + u (6 + m);
// p = 2 d + u (12 + 2 d); 2 p + u (24 + 2 p), below 140.1 u.
//
// in_circle: differences of ring vertices are exact, at most 2; squares and their sum are of 52 bits at most, exact; so are minors (2^25 units
// each, 51 bits). What is rounded are three products and two sums: of at most 8 * 8 = 64 each. (1+u)^3 - 1 times the sum of the absolute products
// bounds it; that sum as computed is too small by (1-u)^3 at most.
#pragma once

#include <cmath>

#include "exact/multires/grid.h"

namespace clues::fastpath::multires {

using exact::DiskPoint;

inline constexpr double kSideError = 0x1.42p-48;      // 40.25 u
inline constexpr double kMiddleError = 0x1.19p-46;    // 140.5 u
inline constexpr double kInCircleError = 0x1.81p-52;  // 3.0078 u, times the sum of the absolute products

inline constexpr int unsure = 2;

struct DiskDouble {
  double x = 0, y = 0;
};
inline DiskDouble in_doubles(const DiskPoint& p) {
  return {static_cast<double>(p[0]) * 0x1p-24, static_cast<double>(p[1]) * 0x1p-24};
}

// -1, 0, 1: of a point to the left of a -> b or not; or unsure. `times`: the point is a sum of so many. `error` is a parameter so that a test can show what
// a smaller one does.
inline int side_filtered(const DiskDouble& a, const DiskDouble& b, const DiskDouble& f, double times = 1,
                         double error = kSideError) {
  const double value = (b.x - a.x) * (f.y - times * a.y) - (b.y - a.y) * (f.x - times * a.x);
  return value > error ? 1 : (value < -error ? -1 : unsure);
}
inline int middle_filtered(const DiskDouble& a, const DiskDouble& b, const DiskDouble& sum,
                           double error = kMiddleError) {
  return side_filtered(a, b, sum, 3, error);
}

inline std::int64_t short_orientation(const DiskPoint& a, const DiskPoint& b, const DiskPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Of points of one triangle, by weights of its second and third corner: twice the area, in units of 2^-120.
using TrianglePlace = std::array<std::int64_t, 2>;
inline TrianglePlace place_in(const scene::Triangle& triangle, const scene::CarrierPoint& p) {
  return {p.weight_of(triangle[1]), p.weight_of(triangle[2])};
}
inline exact::Wide area_of(const TrianglePlace& a, const TrianglePlace& b, const TrianglePlace& c) {
  const std::int64_t bu = b[0] - a[0], bv = b[1] - a[1], cu = c[0] - a[0], cv = c[1] - a[1];
  return exact::Wide{bu} * cv - exact::Wide{bv} * cu;
}

inline int in_circle_filtered(const DiskPoint& a, const DiskPoint& b, const DiskPoint& c, const DiskPoint& d,
                              double error = kInCircleError) {
  const std::int64_t ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0],
                     cy = c[1] - d[1];
  const double p = static_cast<double>(ax * ax + ay * ay) * static_cast<double>(bx * cy - by * cx),
               q = static_cast<double>(bx * bx + by * by) * static_cast<double>(cx * ay - cy * ax),
               r = static_cast<double>(cx * cx + cy * cy) * static_cast<double>(ax * by - ay * bx);
  const double value = p + q + r, bound = error * (std::abs(p) + std::abs(q) + std::abs(r));
  return value > bound ? 1 : (value < -bound ? -1 : unsure);
}

}  // namespace clues::fastpath::multires
