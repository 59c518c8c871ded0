// Plain rational vectors for the exact visible set: no lazy numbers, so that long searches neither grow histories nor pay for them.
#pragma once

#include <gmpxx.h>

#include <array>

#include "exact/kernel.h"

namespace clues::validate {

using Integer = mpz_class;
using Rational = mpq_class;
using RVector = std::array<Rational, 3>;
using IVector = std::array<Integer, 3>;

template <class T>
std::array<T, 3> sum(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] + b[0]), T(a[1] + b[1]), T(a[2] + b[2])};
}
template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}
template <class T>
std::array<T, 3> times(const std::array<T, 3>& a, const T& factor) {
  return {T(a[0] * factor), T(a[1] * factor), T(a[2] * factor)};
}
template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}
template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
bool is_zero(const std::array<T, 3>& a) {
  return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0;
}

// The shortest integer vector in the direction of a.
IVector primitive(const RVector& a);
// a and b times one common positive factor that makes all six numbers integers without a common divisor.
void make_primitive(const RVector& a, const RVector& b, IVector& a_out, IVector& b_out);

RVector read(const exact::Point3& p);
exact::Point3 to_point(const RVector& p);

}  // namespace clues::validate
