#include "fastpath/visibility/closure/sight_rays.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/closure/marks.h"

namespace clues::fastpath {

namespace {

// Rays past each edge of a triangle: half of them past a corner.
constexpr std::size_t kPerEdge = 8, kBeside = 3 * kPerEdge;

// splitmix64: the same numbers for a ray whoever shoots it.
class Numbers {
 public:
  Numbers(std::uint64_t purpose, std::uint64_t ray) : state_((purpose << 56U) ^ (ray * 0xd1342543de82ef95ULL)) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

// Mostly near a vertex of the cell, where most is seen from; else anywhere. Inside the cell but for roundings.
Point point_of_cell(const Cell& cell, Numbers& random) {
  const auto& vertices = cell.vertices();
  const std::uint64_t choice = random.next();
  const std::size_t vertex = (choice >> 2U) % vertices.size();
  const double others = choice % 4 == 0 ? 1 : 0x1p-7;
  Point p{};
  double sum = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double weight = i == vertex ? 1 : others * random.unit();
    sum += weight;
    for (std::size_t k = 0; k < 3; ++k) p[k] += weight * vertices[i][k];
  }
  for (double& x : p) x /= sum;
  return p;
}

bool is_finite(const Segment& s) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(s.a.begin(), s.a.end(), finite) && std::all_of(s.b.begin(), s.b.end(), finite);
}

}  // namespace

// Counts them.
std::size_t SightRays::within_budget(std::size_t count) {
  if (budget_ != exact::Dials::kOwn) count = std::min<std::size_t>(count, static_cast<std::uint64_t>(budget_) - count_);
  count_ += count;
  return count;
}

template <class RayOf>
std::vector<std::uint32_t> SightRays::first_hits(std::size_t count, const RayOf& ray_of) {
  std::vector<std::uint32_t> met(count, kNothing);
  count = within_budget(count);
  const Except except{{}, cell_is_empty_ ? nullptr : &cell_};
  tbb::enumerable_thread_specific<SegmentQueries> queries(std::cref(bvh_));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const tbb::blocked_range<std::size_t>& range) {
    SegmentQueries& mine = queries.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Segment ray = ray_of(i);
      if (is_finite(ray)) met[i] = mine.first_hit(ray, except).value_or(kNothing);
    }
  });
  return met;
}

Segment SightRays::ray_around(std::size_t i, std::size_t count, std::size_t time) const {
  const double reach = 4 / bvh_.frame().scale;  // to beyond the scene
  Numbers random(1, time * count + i);
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
  const double turn =
                   (static_cast<double>(i) + 0.3 * static_cast<double>(time)) * std::numbers::pi * (3 - std::sqrt(5.0)),
               r = std::sqrt(1 - z * z);
  const Point from = point_of_cell(cell_, random);
  return {from, {from[0] + reach * r * std::cos(turn), from[1] + reach * r * std::sin(turn), from[2] + reach * z}};
}

std::vector<std::uint32_t> SightRays::around(std::size_t count, std::size_t time) {
  return first_hits(count, [&](std::size_t i) { return ray_around(i, count, time); });
}

Segment SightRays::ray_beside(std::span<const std::uint32_t> triangles, std::size_t i) const {
  const double reach = 4 / bvh_.frame().scale;
  const std::uint32_t triangle = triangles[i / kBeside];
  const std::size_t number = i % kBeside, edge = number % 3;
  Numbers random(2, triangle * kBeside + number);
  const Corners t = bvh_.corners(triangle);
  const Point from = point_of_cell(cell_, random);
  // At a corner, anywhere, near the one end, near the other.
  const double position = random.unit(), near_end = std::exp2(-2 - 6 * position);
  const double along = std::array{0.0, position, near_end, 1 - near_end}[number / 3 % 4];
  const double off = std::exp2(-4 - 7 * random.unit());
  Segment ray{from, {}};
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double on_edge = t[edge][k] + along * (t[(edge + 1) % 3][k] - t[edge][k]);
    const double center = t[0][k] / 3 + t[1][k] / 3 + t[2][k] / 3;
    ray.b[k] = on_edge + off * (on_edge - center) - from[k];
    size = std::max(size, std::fabs(ray.b[k]));
  }
  for (std::size_t k = 0; k < 3; ++k) ray.b[k] = from[k] + ray.b[k] * (reach / size);
  return ray;
}

std::vector<std::uint32_t> SightRays::beside(std::span<const std::uint32_t> triangles) {
  return first_hits(kBeside * triangles.size(), [&](std::size_t i) { return ray_beside(triangles, i); });
}

Segment SightRays::ray_towards(std::uint32_t triangle, std::size_t number, std::size_t of,
                               std::uint64_t purpose) const {
  Numbers random(purpose, triangle * of + number);
  const Corners t = bvh_.corners(triangle);
  Segment ray{point_of_cell(cell_, random), {}};
  // Closer to one corner or less: what is seen of a triangle in part, is most often its corners.
  const std::size_t corner = number % 3;
  const double size = std::exp2(-5 * random.unit()), u = size * random.unit(), v = (size - u) * random.unit();
  for (std::size_t k = 0; k < 3; ++k)
    ray.b[k] = (1 - u - v) * t[corner][k] + u * t[(corner + 1) % 3][k] + v * t[(corner + 2) % 3][k];
  return ray;
}

std::vector<std::uint32_t> SightRays::towards(std::span<const std::uint32_t> triangles) {
  return first_hits(kTowards * triangles.size(),
                    [&](std::size_t i) { return ray_towards(triangles[i / kTowards], i % kTowards, kTowards, 3); });
}

std::vector<std::uint8_t> SightRays::met_towards(std::span<const std::uint32_t> triangles) {
  const std::size_t count = within_budget(kMetTowards * triangles.size());
  tbb::enumerable_thread_specific<SegmentQueries> queries(std::cref(bvh_));
  return marks(bvh_.mesh().triangles.size(), count, [&](std::size_t i, std::vector<std::uint8_t>& met) {
    const Segment ray = ray_towards(triangles[i / kMetTowards], i % kMetTowards, kMetTowards, 4);
    if (!is_finite(ray)) return;
    for (const std::uint32_t t : queries.local().all_hits(ray)) met[t] = 1;
  });
}

Sights sights_from(const Bvh& bvh, const Cell& cell) {
  SightRays rays(bvh, cell);
  Sights sights;
  std::vector<std::uint8_t> seen(bvh.mesh().triangles.size(), 0);
  rays.look_around([&](std::uint32_t triangle, const auto& ray) {
    if (seen[triangle] != 0) return false;
    seen[triangle] = 1;
    sights.triangles.push_back(triangle);
    sights.rays.push_back(ray());
    return true;
  });
  sights.shot = rays.count();
  return sights;
}

}  // namespace clues::fastpath
