// Directions and sight lines.
#include "fastpath/motion/sampling.h"

#include <algorithm>
#include <cmath>

namespace clues::fastpath::motion {
namespace {

std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

double fraction(std::uint64_t bits) { return static_cast<double>(bits >> 32U) * 0x1p-32; }

// From the middle of a side of the cube to its border; nearly the tangent of x times 45 degrees, so that cells are of nearly one size.
double spread(double x) { return x * (0x1.95p-1 + (1 - 0x1.95p-1) * x * x); }

}  // namespace

std::vector<MotionPoint> directions(std::uint32_t count, std::uint64_t seed) {
  if (count == 0) return {};
  std::uint64_t side = 1;
  while (6 * side * side < count) ++side;
  const std::uint64_t cells = 6 * side * side;
  // Evenly chosen cells, in rows that go there and back; a cell is in the last round with a chance of one half, in the one before with half of that ...
  std::vector<std::vector<MotionPoint>> rounds(24);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t cell = i * cells / count, face = cell / (side * side), row = cell / side % side;
    const std::uint64_t column = row % 2 == 0 ? cell % side : side - 1 - cell % side;
    const std::uint64_t random = mixed(seed * 0x100000001b3ULL + cell), other = mixed(random);
    const auto along = [&](std::uint64_t k, double jitter) {
      return spread((static_cast<double>(k) + 0.15 + 0.7 * jitter) * 2 / static_cast<double>(side) - 1);
    };
    const double u = along(column, fraction(random)), v = along(row, fraction(random << 32U));
    MotionPoint d{};
    d[face % 3] = face < 3 ? 1 : -1;
    d[(face + 1) % 3] = u;
    d[(face + 2) % 3] = v;
    std::size_t round = 0;
    while (round + 1 < rounds.size() && ((other >> round) & 1U) != 0) ++round;
    rounds[round].push_back(d);
  }
  std::vector<MotionPoint> all;
  for (std::size_t k = rounds.size(); k-- > 0;) all.insert(all.end(), rounds[k].begin(), rounds[k].end());
  return all;
}

Sampler::Sampler(const Bvh& bvh) : bvh_(&bvh), queries_(bvh) {
  const auto& points = bvh.mesh().points;
  if (points.empty()) return;
  low_ = high_ = points[0];
  for (const Point& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = std::min(low_[i], p[i]);
      high_[i] = std::max(high_[i], p[i]);
    }
  }
}

std::optional<Point> Sampler::beyond(const MotionPoint& at, const MotionPoint& direction) const {
  double size = 0, reach = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    size = std::max(size, std::fabs(direction[i]));
    reach += std::max({std::fabs(low_[i] - at[i]), std::fabs(high_[i] - at[i]), high_[i] - low_[i]});
  }
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  Point end{};
  for (std::size_t i = 0; i < 3; ++i) {
    end[i] = at[i] + direction[i] / size * (2 * reach);
    if (!std::isfinite(end[i])) return std::nullopt;
  }
  return end;
}

std::optional<DepthSample> Sampler::sample(const MotionPoint& at, const MotionPoint& direction) {
  const auto end = beyond(at, direction);
  if (!end) return std::nullopt;
  ++rays;
  const Segment segment{at, *end};
  const auto hit = queries_.first_hit(segment);
  if (!hit) return DepthSample{direction, true, false};
  // Where it crosses the plane, as doubles tell it; a triangle that is seen along its plane gives no sample.
  const Corners corners = bvh_->corners(*hit);
  const Filtered at_start = orient3d_value(corners[0], corners[1], corners[2], segment.a);
  const Filtered at_end = orient3d_value(corners[0], corners[1], corners[2], segment.b);
  const double here = std::fabs(at_start.value), there = std::fabs(at_end.value);
  if (!at_start.in_range || !at_end.in_range || !(at_start.bound < 0x1p-20 * here)) return std::nullopt;
  const double t = here / (here + there);
  DepthSample sample;
  for (std::size_t i = 0; i < 3; ++i) sample.at[i] = at[i] + t * ((*end)[i] - at[i]);
  return sample;
}

bool Sampler::sees(const MotionPoint& at, const DepthSample& sample) {
  Point end = sample.at;
  if (sample.is_direction) {
    const auto far = beyond(at, sample.at);
    if (!far) return false;
    end = *far;
  } else {
    for (std::size_t i = 0; i < 3; ++i) end[i] += (at[i] - end[i]) * 0x1p-20;
  }
  ++rays;
  return !queries_.any_hit({at, end});
}

}  // namespace clues::fastpath::motion
