// A sample as the viewpoint sees it, in doubles (D28): what all filters and bounds of a walk are computed from.
//
// With u = 2^-53: each coordinate of x is within a relative u of the exact difference (a direction is exact). So is the vector; the squares, two sums
// and the root add (1+u)^(5/2): `length` is within a relative 4u of the exact length. Lengths outside of [2^-100, 2^100] are left to exact
// arithmetic: within, no product of up to eight of them overflows, and what underflows is below 2^-1074 times 2^400, far
// less than any bound here, which is at least 2^-50 times 2^-400.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fastpath/predicates/float_rules.h"
#include "scene/motion/depth_mesh.h"

namespace clues::fastpath::motion {

using scene::DepthSample;
using scene::MotionPoint;

struct Vec {
  double x = 0, y = 0, z = 0;
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec& a, const Vec& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }

struct Row {
  Vec x;
  double length = 0;
  bool moves = true;  // a point; a direction is the same from everywhere
};

inline constexpr double kLeastLength = 0x1p-100, kLargestLength = 0x1p100;

inline bool fits(const Row& r) { return r.length >= kLeastLength && r.length <= kLargestLength; }

inline Row row_of(const DepthSample& sample, const MotionPoint& viewpoint) {
  Row row;
  row.moves = !sample.is_direction;
  row.x = {sample.at[0], sample.at[1], sample.at[2]};
  if (row.moves) row.x = row.x - Vec{viewpoint[0], viewpoint[1], viewpoint[2]};
  row.length = norm(row.x);
  return row;
}

// An upper bound of |a - b|: the root of the sum has a relative error below 4u, or an absolute one where squares underflow.
inline double distance_up(const MotionPoint& a, const MotionPoint& b) {
  const Vec d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  if (d.x == 0 && d.y == 0 && d.z == 0) return 0;
  return norm(d) * (1 + 0x1p-50) + 0x1p-500;
}

}  // namespace clues::fastpath::motion
