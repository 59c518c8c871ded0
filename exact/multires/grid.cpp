#include "exact/multires/grid.h"

namespace clues::exact {

int in_circle(const DiskPoint& a, const DiskPoint& b, const DiskPoint& c, const DiskPoint& d) {
  const auto row = [&](const DiskPoint& p) {
    const Wide x = p[0] - d[0], y = p[1] - d[1];
    return std::array<Wide, 3>{x, y, x * x + y * y};
  };
  const auto p = row(a), q = row(b), r = row(c);
  return sign_of(p[2] * (q[0] * r[1] - q[1] * r[0]) + q[2] * (r[0] * p[1] - r[1] * p[0]) +
                 r[2] * (p[0] * q[1] - p[1] * q[0]));
}

Wide area_in(const scene::Triangle& triangle, const scene::CarrierPoint& a, const scene::CarrierPoint& b,
             const scene::CarrierPoint& c) {
  const std::int64_t u = a.weight_of(triangle[1]), v = a.weight_of(triangle[2]);
  const Wide bu = b.weight_of(triangle[1]) - u, bv = b.weight_of(triangle[2]) - v;
  const Wide cu = c.weight_of(triangle[1]) - u, cv = c.weight_of(triangle[2]) - v;
  return bu * cv - bv * cu;
}

int orientation_in(const scene::Triangle& triangle, const scene::CarrierPoint& a, const scene::CarrierPoint& b,
                   const scene::CarrierPoint& c) {
  return sign_of(area_in(triangle, a, b, c));
}

}  // namespace clues::exact
