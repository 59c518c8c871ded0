// Stage 2 of the segment queries (D5): orientation signs of double points in double arithmetic, each with a bound on its own
// error, and what follows from them for a segment and a triangle. Never wrong: it answers, or says that it cannot. Signs are
// those of CGAL::orientation: orient3d(a,b,c,d) > 0 when a, b, c turn left seen from d.
#pragma once

#include <array>
#include <cmath>

#include "exact/dials.h"
#include "fastpath/predicates/float_rules.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath {

using scene::Point;
using Corners = std::array<Point, 3>;

struct Segment {
  Point a{}, b{};
};

enum class Sign : signed char { negative = -1, zero = 0, positive = 1 };

// A sign, or none: "not certain" is a state of its own, not a value of the sign.
struct FilteredSign {
  bool certain = false;
  Sign sign = Sign::zero;
};

// A determinant as computed and a bound on its distance from the exact one; without `in_range` neither means anything.
struct Filtered {
  double value = 0, bound = 0;
  bool in_range = false;

  FilteredSign sign() const {
    if (!in_range || exact::process_dials::is_on(exact::process_dials::unsure_doubles)) return {};
    if (value > bound) return {true, Sign::positive};
    if (value < -bound) return {true, Sign::negative};
    return {bound == 0, Sign::zero};  // a bound of 0 means that every term is a true zero
  }
};

// The error of orient3d in double. With u = 2^-53, each of the six terms of the determinant is a product of three differences.
// Rounded on its way: 3 differences, the product of two, the difference of two products, the product with the third, 2 sums:
// 8 factors (1 + d), |d| <= u. So |computed - exact| <= ((1+u)^8 - 1) P, where P is the sum of the six terms' absolute values.
// P is computed in the same way from terms of one sign, hence at least (1-u)^8 P; the product with the constant loses (1-u) once
// more. The constant is ((1+u)^8 - 1) / (1-u)^9 rounded up to a double; a test recomputes it. No factor underflows or overflows:
// differences are 0 or between 2^-300 and 2^300, so products of three stay above 2^-953 (a difference of two products is 0 or at
// least 2^-653) and below 2^903.
inline constexpr double kOrient3dError = 0x1.0000000000007p-50;
inline constexpr double kLeastDifference = 0x1p-300, kLargestDifference = 0x1p300;

// `error` is a parameter so that a test can show what a smaller one does.
inline Filtered orient3d_value(const Point& a, const Point& b, const Point& c, const Point& d,
                               double error = kOrient3dError) {
  const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
  const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
  const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
  const auto fits = [](double x) {
    const double size = std::fabs(x);
    return (size >= kLeastDifference && size <= kLargestDifference) || size == 0;
  };
  Filtered out;
  out.in_range =
      fits(ax) && fits(ay) && fits(az) && fits(bx) && fits(by) && fits(bz) && fits(cx) && fits(cy) && fits(cz);
  const double bycz = by * cz, bzcy = bz * cy, bzcx = bz * cx, bxcz = bx * cz, bxcy = bx * cy, bycx = by * cx;
  // -det(a-d, b-d, c-d) = det(b-a, c-a, d-a)
  out.value = -((ax * (bycz - bzcy) + ay * (bzcx - bxcz)) + az * (bxcy - bycx));
  const double size =
      (std::fabs(ax) * (std::fabs(bycz) + std::fabs(bzcy)) + std::fabs(ay) * (std::fabs(bzcx) + std::fabs(bxcz))) +
      std::fabs(az) * (std::fabs(bxcy) + std::fabs(bycx));
  out.bound = error * size;
  return out;
}

inline FilteredSign orient3d_filtered(const Point& a, const Point& b, const Point& c, const Point& d,
                                      double error = kOrient3dError) {
  return orient3d_value(a, b, c, d, error).sign();
}

enum class Meets : unsigned char { no, yes, unsure };

// Whether the open segment meets the closed triangle, which has area. Unsure when a sign that matters is, and when the
// segment may lie in the triangle's plane.
inline Meets meets_filtered(const Segment& s, const Corners& t, double error = kOrient3dError) {
  const FilteredSign at_a = orient3d_filtered(t[0], t[1], t[2], s.a, error);
  const FilteredSign at_b = orient3d_filtered(t[0], t[1], t[2], s.b, error);
  const bool planes_certain = at_a.certain && at_b.certain;
  if (planes_certain && at_a.sign == at_b.sign) return at_a.sign == Sign::zero ? Meets::unsure : Meets::no;
  // One end in the plane, the other not: the line meets the plane at that end only, which an open segment does not contain.
  if (planes_certain && (at_a.sign == Sign::zero || at_b.sign == Sign::zero)) return Meets::no;
  // The line passes each edge on the left or on the right, or meets its line. In the triangle's plane all three are zero.
  bool left = false, right = false, certain = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const FilteredSign side = orient3d_filtered(s.a, s.b, t[i], t[(i + 1) % 3], error);
    certain = certain && side.certain;
    left = left || (side.certain && side.sign == Sign::positive);
    right = right || (side.certain && side.sign == Sign::negative);
  }
  if (left && right) return Meets::no;
  return certain && planes_certain ? Meets::yes : Meets::unsure;
}

// The parameter (0 at s.a, 1 at s.b) where the segment crosses the plane of t: an interval that contains it; [0,1] if the filter
// cannot tell that it crosses. The true value is |A| / (|A| + |B|) for the determinants A, B at the ends, increasing in |A| and
// decreasing in |B|; each bound costs four roundings, of a relative 2^-53 each, which the last factor makes up for.
struct Range {
  double low = 0, high = 1;
};

inline Range crossing_parameter(const Segment& s, const Corners& t) {
  const Filtered at_a = orient3d_value(t[0], t[1], t[2], s.a), at_b = orient3d_value(t[0], t[1], t[2], s.b);
  const FilteredSign sign_a = at_a.sign(), sign_b = at_b.sign();
  if (!sign_a.certain || !sign_b.certain || sign_a.sign == Sign::zero || sign_b.sign == Sign::zero ||
      sign_a.sign == sign_b.sign) {
    return {};
  }
  const double a = std::fabs(at_a.value), b = std::fabs(at_b.value);
  const double a_low = a - at_a.bound, a_high = a + at_a.bound, b_low = b - at_b.bound, b_high = b + at_b.bound;
  return {a_low / (a_low + b_high) * (1 - 0x1p-50), std::fmin(1.0, a_high / (a_high + b_low) * (1 + 0x1p-50))};
}

}  // namespace clues::fastpath
