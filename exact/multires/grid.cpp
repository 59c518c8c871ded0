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

scene::CarrierPoint rounded_point(std::array<std::pair<std::uint32_t, std::int64_t>, 3> weights, std::int64_t left) {
  if (weights[1] < weights[0]) std::swap(weights[0], weights[1]);
  if (weights[2] < weights[1]) std::swap(weights[1], weights[2]);
  if (weights[1] < weights[0]) std::swap(weights[0], weights[1]);
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (weights[k].second > weights[largest].second) largest = k;
  }
  weights[largest].second += left;
  scene::CarrierPoint out;
  std::size_t used = 0;
  for (const auto& [vertex, weight] : weights) {
    if (weight == 0) continue;
    out.corner[used] = vertex;
    out.weight[used++] = weight;
  }
  return out;
}

}  // namespace clues::exact
