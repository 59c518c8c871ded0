#include "fastpath/multires/crossing.h"

#include <algorithm>

namespace clues::fastpath::multires {

using exact::DiskPoint;
using exact::FlatPoint;
using scene::CarrierPoint;

namespace {

double in_double(Wide a) {
  return static_cast<double>(static_cast<std::int64_t>(a >> 62)) * 0x1p62 +
         static_cast<double>(static_cast<std::int64_t>(a & ((Wide{1} << 62) - 1)));
}

// floor(part / area) for 0 <= part <= 2^60 area, area < 2^51, and what is left over. The guess is wrong by four roundings, of at most 2^60: less than
// 2^10. So what is left over after it is below 2^61, and 64 bits, in which it is computed, hold it.
struct Ratio {
  std::int64_t whole, rest;
};
Ratio ratio_of(Wide part, std::int64_t area) {
  const double about = static_cast<double>(area);
  auto q = static_cast<std::int64_t>(in_double(part) / about);
  auto rest = static_cast<std::int64_t>(static_cast<std::uint64_t>(part) -
                                        static_cast<std::uint64_t>(q) * static_cast<std::uint64_t>(area));
  while (rest < 0 || rest >= area) {
    auto step = static_cast<std::int64_t>(static_cast<double>(rest) / about);
    if (step == 0) step = rest < 0 ? -1 : 1;
    q += step;
    rest -= step * area;
  }
  return {q, rest};
}

// floor(part (x - y) / whole) for weights x, y and 0 < part < whole < 2^113. The guess is wrong by at most six roundings, of at most 2^60: less
// than 2^11. So what is left over after it is below 2^124, and 128 bits, in which it is computed, hold it.
std::int64_t share_of(Wide part, Wide whole, std::int64_t difference) {
  const double about = in_double(whole);
  auto q = static_cast<std::int64_t>(in_double(part) / about * static_cast<double>(difference));
  auto rest = static_cast<Wide>(static_cast<WideBits>(part) * static_cast<WideBits>(Wide{difference}) -
                                static_cast<WideBits>(Wide{q}) * static_cast<WideBits>(whole));
  while (rest < 0 || rest >= whole) {
    auto step = static_cast<std::int64_t>(in_double(rest) / about);
    if (step == 0) step = rest < 0 ? -1 : 1;
    q += step;
    rest -= step * whole;
  }
  return q;
}

}  // namespace

// The three parts sum to 2^60 times the area, so that two quotients give the third.
std::optional<CarrierPoint> weights_in(const scene::Triangle& triangle, const std::array<DiskPoint, 3>& corners,
                                       const FlatPoint& point) {
  const auto area = static_cast<std::int64_t>(exact::orientation(corners[0], corners[1], corners[2]));
  const Wide first = exact::orientation(corners[1], corners[2], point),
             second = exact::orientation(corners[2], corners[0], point);
  const Ratio p = ratio_of(first, area), q = ratio_of(second, area);
  if ((first > 0 && p.whole == 0) || (second > 0 && q.whole == 0)) return std::nullopt;
  const std::int64_t missing = scene::whole_weight - p.whole - q.whole, rest = p.rest + q.rest;
  const std::int64_t r = missing - (rest == 0 ? 0 : (rest <= area ? 1 : 2));
  if (r == 0 && missing * area > rest) return std::nullopt;
  return exact::rounded_point({{{triangle[0], p.whole}, {triangle[1], q.whole}, {triangle[2], r}}}, missing - r);
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
  const Wide whole = parts.of_x + parts.of_y;
  std::int64_t left = scene::whole_weight;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < used; ++k) {
    const std::int64_t at_y = y.weight_of(out.corner[k]), more = x.weight_of(out.corner[k]) - at_y;
    out.weight[k] = std::max<std::int64_t>(1, at_y + share_of(parts.of_x, whole, more));  // on the side that it is on
    if (out.weight[k] > out.weight[largest]) largest = k;
    left -= out.weight[k];
  }
  out.weight[largest] += left;
  return out;
}

}  // namespace clues::fastpath::multires
