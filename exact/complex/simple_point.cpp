#include "exact/complex/simple_point.h"

#include <cmath>

#include "exact/complex/complex_internal.h"

namespace clues::exact {
namespace {

constexpr double kDenominators[kSimpleLevels] = {251, 65521, 16777213, 274877906857.0};

// none where doubles end, so far out that they are all whole
std::optional<FT> rounded(double x, int level) {
  const double d = kDenominators[level], whole = std::nearbyint(x * d);
  if (!std::isfinite(whole)) return std::nullopt;
  return FT(whole) / FT(d);
}

}  // namespace

FT simple_near(const FT& x, int level) { return rounded(CGAL::to_double(x), level).value_or(x); }

std::optional<Point3> simple_in_triangle(const Point3& x, const std::array<Point3, 3>& corners, int level) {
  const auto& [a, b, c] = corners;
  const int axis = dominant_axis(CGAL::cross_product(b - a, c - a));
  const auto flat = [&](const Point3& p) {
    const scene::Point d = to_double_estimate(p);
    return std::array<double, 2>{d[static_cast<std::size_t>((axis + 1) % 3)],
                                 d[static_cast<std::size_t>((axis + 2) % 3)]};
  };
  const auto fa = flat(a), fb = flat(b), fc = flat(c), fx = flat(x);
  const auto cross = [](const auto& o, const auto& p, const auto& q) {
    return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
  };
  const double area = cross(fa, fb, fc);
  if (area == 0) return std::nullopt;
  const auto u = rounded(cross(fa, fx, fc) / area, level), w = rounded(cross(fa, fb, fx) / area, level);
  if (!u || !w || !CGAL::is_positive(*u) || !CGAL::is_positive(*w) || *u + *w >= FT(1)) return std::nullopt;
  return collapsed(a + *u * (b - a) + *w * (c - a));
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
