#include "fastpath/multires/crossing.h"

#include <algorithm>

namespace clues::fastpath::multires {

using exact::DiskPoint;
using exact::FlatPoint;
using scene::CarrierPoint;

std::optional<CarrierPoint> weights_in(const scene::Triangle& triangle, const std::array<DiskPoint, 3>& corners,
                                       const FlatPoint& point) {
  const Wide area = exact::orientation(corners[0], corners[1], corners[2]);
  std::array<std::pair<std::uint32_t, std::int64_t>, 3> weights;
  std::int64_t left = scene::whole_weight;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide part = exact::orientation(corners[(k + 1) % 3], corners[(k + 2) % 3], point);
    Wide rest = 0;
    weights[k] = {triangle[k], quotient(part, area, rest)};
    if (part > 0 && weights[k].second == 0) return std::nullopt;
    left -= weights[k].second;
  }
  std::sort(weights.begin(), weights.end());
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (weights[k].second > weights[largest].second) largest = k;
  }
  weights[largest].second += left;
  CarrierPoint out;
  std::size_t used = 0;
  for (const auto& [vertex, weight] : weights) {
    if (weight == 0) continue;
    out.corner[used] = vertex;
    out.weight[used++] = weight;
  }
  return out;
}

// Along the axis on which the diagonal is longer. From a, in units of 2^-84 over the sum of the parts; the diagonal has its length times 2^60 times
// that sum of them. 87 + 112 bits at most, and 25 + 60 + 113.
std::optional<std::int64_t> place_on_diagonal(const DiskPoint& a, const DiskPoint& b, const FlatPoint& x,
                                              const FlatPoint& y, const Parts& parts) {
  const std::int64_t dx = b[0] - a[0], dy = b[1] - a[1];
  const bool along_x = std::abs(dx) >= std::abs(dy);
  const std::int64_t length = along_x ? dx : dy;
  const Wide from = Wide{along_x ? a[0] : a[1]} * scene::whole_weight;
  const Wide p = (along_x ? x.x : x.y) - from, q = (along_x ? y.x : y.y) - from;
  Wide256 way = product(p, parts.of_x) + product(q, parts.of_y);
  if (length < 0) way = -way;
  const Wide256 unit = times(widened(parts.of_x + parts.of_y), std::abs(length));
  if (way.negative() || way.zero() || !(way - times(unit, scene::whole_weight)).negative()) return std::nullopt;
  Wide256 rest;
  return quotient(way, unit, rest);
}

std::optional<CarrierPoint> mean_of(const CarrierPoint& x, const CarrierPoint& y, const Parts& parts) {
  CarrierPoint out;
  std::size_t used = 0;
  const auto add = [&](std::uint32_t v) {
    if (v == scene::no_vertex || std::find(out.corner.begin(), out.corner.end(), v) != out.corner.end()) return true;
    if (used == 3) return false;
    out.corner[used++] = v;
    return true;
  };
  for (const auto* p : {&x, &y}) {
    for (const std::uint32_t v : p->corner) {
      if (!add(v)) return std::nullopt;
    }
  }
  std::sort(out.corner.begin(), out.corner.end());
  const Wide256 whole = widened(parts.of_x + parts.of_y);
  std::int64_t left = scene::whole_weight;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < used; ++k) {
    Wide256 rest;
    const Wide256 sum =
        product(parts.of_x, x.weight_of(out.corner[k])) + product(parts.of_y, y.weight_of(out.corner[k]));
    out.weight[k] = std::max<std::int64_t>(1, quotient(sum, whole, rest));  // on the side that it is on
    if (out.weight[k] > out.weight[largest]) largest = k;
    left -= out.weight[k];
  }
  out.weight[largest] += left;
  return out;
}

}  // namespace clues::fastpath::multires
