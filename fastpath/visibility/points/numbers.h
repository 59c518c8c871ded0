// The number types of the fast path's visibility code: intervals of doubles, rounded outward; rationals; whole numbers. Code is written once as
// a template; `sign_of` of an interval that holds zero and more throws Unsure, and the caller does the same again in rationals.
//
// Intervals need the rounding mode of RoundedUp in scope.
#pragma once

#include <CGAL/Interval_nt.h>
#include <gmpxx.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

#include "exact/dials.h"

namespace clues::fastpath {

using Interval = CGAL::Interval_nt<false>;
using Rational = mpq_class;
// Up to 512 bits without allocation; unlimited beyond.
using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;
using RoundedUp = Interval::Protector;

struct Unsure {};

inline constexpr int kUnsure = 2;

// -1, 0, 1, or kUnsure; exact numbers are never unsure.
inline int filtered_sign(const Interval& x) {
  if (exact::process_dials::is_on(exact::process_dials::unsure_intervals)) [[unlikely]]
    return kUnsure;
  if (x.inf() > 0) return 1;
  if (x.sup() < 0) return -1;
  return x.inf() == 0 && x.sup() == 0 ? 0 : kUnsure;
}

inline int sign_of(const Interval& x) {
  const int s = filtered_sign(x);
  if (s == kUnsure) throw Unsure{};
  return s;
}
inline int sign_of(const Rational& x) { return sgn(x); }
inline int sign_of(const Integer& x) { return x.sign(); }
inline int filtered_sign(const Rational& x) { return sgn(x); }
inline int filtered_sign(const Integer& x) { return x.sign(); }

template <class NT>
struct Vec3 {
  NT x, y, z;
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {NT(a.x + b.x), NT(a.y + b.y), NT(a.z + b.z)}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {NT(a.x - b.x), NT(a.y - b.y), NT(a.z - b.z)}; }
  friend Vec3 operator*(const NT& s, const Vec3& a) { return {NT(s * a.x), NT(s * a.y), NT(s * a.z)}; }
  friend Vec3 operator-(const Vec3& a) { return {NT(-a.x), NT(-a.y), NT(-a.z)}; }
};

template <class NT>
const NT& coordinate(const Vec3<NT>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
template <class NT>
NT& coordinate(Vec3<NT>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <class NT>
NT dot(const Vec3<NT>& a, const Vec3<NT>& b) {
  return NT(NT(a.x * b.x) + NT(a.y * b.y)) + NT(a.z * b.z);
}
template <class NT>
Vec3<NT> cross(const Vec3<NT>& a, const Vec3<NT>& b) {
  return {NT(NT(a.y * b.z) - NT(a.z * b.y)), NT(NT(a.z * b.x) - NT(a.x * b.z)), NT(NT(a.x * b.y) - NT(a.y * b.x))};
}
// Of intervals with all products in line: the compiler's own choice is to call each of them.
[[gnu::flatten]] inline Interval dot(const Vec3<Interval>& a, const Vec3<Interval>& b) { return dot<Interval>(a, b); }
[[gnu::flatten]] inline Vec3<Interval> cross(const Vec3<Interval>& a, const Vec3<Interval>& b) {
  return cross<Interval>(a, b);
}
template <class NT>
int det_sign(const Vec3<NT>& a, const Vec3<NT>& b, const Vec3<NT>& c) {
  return sign_of(NT(dot(a, cross(b, c))));
}

}  // namespace clues::fastpath
