#include "fuzz/findings/sight_aims.h"

#include <cmath>

#include "exact/sight/scene_query.h"

namespace clues::fuzz {

using exact::Point3;
using scene::Point;

Point on_line(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Point random_mean(const std::vector<Point>& points, int heavy, Random& random) {
  Point sum{};
  double total = 0;
  for (const Point& p : points) {
    const double weight = random.between(1, 64) * (random.one_in(3) ? heavy : 1);
    total += weight;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * p[i];
  }
  for (double& x : sum) x /= total;
  return sum;
}

Point off_by_a_little(Point p, Random& random) {
  for (double& x : p) {
    const int kind = random.between(0, 4);
    if (kind <= 1) x = std::nextafter(x, kind == 0 ? -1e300 : 1e300);
    if (kind >= 3) x += std::ldexp(random.one_in(2) ? 1 : -1, -random.between(10, 40));
  }
  return p;
}

std::optional<validate::Witness> witness_on(std::uint32_t triangle, const exact::TriangleCorners& t, const Point3& v,
                                            const Point3& end) {
  const exact::Plane3 plane(t[0], t[1], t[2]);
  const exact::FT at_v = exact::value_at(plane, v), at_end = exact::value_at(plane, end);
  if (CGAL::is_zero(at_v) || at_v == at_end) return std::nullopt;
  const Point3 p = exact::collapsed(v + at_v / (at_v - at_end) * (end - v));
  for (std::size_t i = 0; i < 3; ++i) {
    if (CGAL::coplanar_orientation(t[i], t[(i + 1) % 3], t[(i + 2) % 3], p) != CGAL::POSITIVE) return std::nullopt;
  }
  return validate::Witness{triangle, CGAL::is_positive(at_v), v, p};
}

}  // namespace clues::fuzz
