// Whole numbers for signs that intervals leave open. What is asked of points is always asked of directions between them, and a direction may be
// multiplied by any positive number: so denominators are cleared, and no fraction is ever reduced to lowest terms.
#pragma once

#include "fastpath/visibility/points/points.h"

namespace clues::fastpath {

// A positive multiple of `to` - `from`; of the difference itself for intervals.
template <class NT>
Vec3<NT> direction(const ExactPoint& from, const ExactPoint& to);
template <>
inline Vec3<Interval> direction<Interval>(const ExactPoint& from, const ExactPoint& to) {
  return to.approximate() - from.approximate();
}
template <>
Vec3<Integer> direction<Integer>(const ExactPoint& from, const ExactPoint& to);

// The sign of the difference of coordinate `axis`.
int compare_exactly(const ExactPoint& a, const ExactPoint& b, int axis);

// A positive multiple of the plane's normal.
template <class NT>
Vec3<NT> normal_direction(const Plane& h);
template <>
inline Vec3<Interval> normal_direction<Interval>(const Plane& h) {
  return h.normal_approximate();
}
template <>
inline Vec3<Integer> normal_direction<Integer>(const Plane& h) {
  return h.normal_direction();
}

// a and b, each multiplied by a positive number so that neither is negligible beside the other.
template <class NT>
Vec3<NT> balanced_sum(const Vec3<NT>& a, const Vec3<NT>& b);
template <>
Vec3<Interval> balanced_sum<Interval>(const Vec3<Interval>& a, const Vec3<Interval>& b);
template <>
Vec3<Integer> balanced_sum<Integer>(const Vec3<Integer>& a, const Vec3<Integer>& b);

// A positive multiple of limit + s aside + t s^2 off, where s is 2^-exponent and t is 1, both times positive numbers that depend on the vectors' sizes only.
template <class NT>
Vec3<NT> moved_by(const Vec3<NT>& limit, const Vec3<NT>& aside, const Vec3<NT>& off, int exponent);
template <>
Vec3<Interval> moved_by<Interval>(const Vec3<Interval>& limit, const Vec3<Interval>& aside, const Vec3<Interval>& off,
                                  int exponent);
template <>
Vec3<Integer> moved_by<Integer>(const Vec3<Integer>& limit, const Vec3<Integer>& aside, const Vec3<Integer>& off,
                                int exponent);

// Around a positive multiple of v.
Vec3<Interval> around_multiple(const Vec3<Integer>& v);

// x + a positive multiple of d, exactly; about this far from x.
ExactPoint point_towards(const ExactPoint& x, const Vec3<Integer>& d, double distance);

}  // namespace clues::fastpath
