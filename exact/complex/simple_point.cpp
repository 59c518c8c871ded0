#include "exact/complex/simple_point.h"

#include <cmath>

#include "exact/complex/complex_internal.h"

namespace clues::exact {
namespace {

constexpr double kDenominators[kSimpleLevels] = {251, 65521, 16777213, 274877906857.0};

using Rational = RationalKernel::FT;

// none where doubles end, so far out that they are all whole
std::optional<Rational> rounded(double x, int level) {
  const double d = kDenominators[level], whole = std::nearbyint(x * d);
  if (!std::isfinite(whole)) return std::nullopt;
  return Rational(Rational(whole) / Rational(d));
}

}  // namespace

FT simple_near(const FT& x, int level) {
  const auto near = rounded(CGAL::to_double(x), level);
  return near ? FT(*near) : x;
}

std::optional<Point3> simple_in_triangle(const Point3& x, const std::array<Point3, 3>& corners, int level) {
  const auto& [a, b, c] = corners;
  const scene::Point fa = to_double_estimate(a), fb = to_double_estimate(b), fc = to_double_estimate(c),
                     fx = to_double_estimate(x);
  // Twice the area of opq as seen along an axis.
  const auto cross = [](const scene::Point& o, const scene::Point& p, const scene::Point& q, std::size_t axis) {
    const std::size_t i = (axis + 1) % 3, k = (axis + 2) % 3;
    return (p[i] - o[i]) * (q[k] - o[k]) - (p[k] - o[k]) * (q[i] - o[i]);
  };
  std::size_t axis = 0;
  for (const std::size_t i : {1U, 2U}) {
    if (std::fabs(cross(fa, fb, fc, i)) > std::fabs(cross(fa, fb, fc, axis))) axis = i;
  }
  const double area = cross(fa, fb, fc, axis);
  if (area == 0) return std::nullopt;
  const auto u = rounded(cross(fa, fx, fc, axis) / area, level), w = rounded(cross(fa, fb, fx, axis) / area, level);
  if (!u || !w || sgn(*u) <= 0 || sgn(*w) <= 0 || *u + *w >= 1) return std::nullopt;
  const RationalKernel::Point_3 &o = a.exact(), &p = b.exact(), &q = c.exact();
  return to_lazy(o + *u * (p - o) + *w * (q - o));
}

Point3 simple_between(const Point3& a, const Point3& b, const Point3& lo, const Point3& hi) {
  const int axis = dominant_axis(b - a);
  const FT length = b[axis] - a[axis];
  const FT t_lo = (lo[axis] - a[axis]) / length, t_hi = (hi[axis] - a[axis]) / length;
  for (int level = 0; level < kSimpleLevels; ++level) {
    const FT t = simple_near((t_lo + t_hi) / FT(2), level);
    if (t_lo < t && t < t_hi) return collapsed(a + t * (b - a));
  }
  return collapsed(CGAL::midpoint(lo, hi));
}

}  // namespace clues::exact
