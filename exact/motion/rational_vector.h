// Vectors of rationals, for distances: not scaled, unlike the rows of sight_row.h.
#pragma once

#include <gmpxx.h>

#include <array>

#include "exact/motion/sight_row.h"

namespace clues::exact {

using RationalVector = std::array<mpq_class, 3>;

inline RationalVector cross(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline mpq_class dot(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RationalVector minus(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline RationalVector plus(const RationalVector& a, const RationalVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline RationalVector times(const RationalVector& a, const mpq_class& factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

// From v to the sample, or the direction as it is.
inline RationalVector seen(const scene::DepthSample& sample, const ExactViewpoint& v) {
  const RationalVector at{mpq_class(sample.at[0]), mpq_class(sample.at[1]), mpq_class(sample.at[2])};
  return sample.is_direction ? at : minus(at, v);
}

// det(a(v), b(v), c(v)) at v + w is `value` + gradient.w, exactly: a direction does not move, and of points the terms with w twice vanish.
struct AffineDeterminant {
  mpq_class value;
  RationalVector gradient;
};
AffineDeterminant affine_determinant(const std::array<const scene::DepthSample*, 3>& samples, const ExactViewpoint& v);

}  // namespace clues::exact
