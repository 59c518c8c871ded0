#include "fastpath/visibility/closure/sight_lines.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <random>

#include "fastpath/predicates/estimated_vectors.h"

namespace clues::fastpath {
namespace {

constexpr int kViewpoints = 64;
constexpr Sign kFront = Sign::negative;  // of orient3d: seen from there the corners turn counter-clockwise

// Random weights that sum to 1.
std::vector<double> weights(std::size_t n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> w(n);
  double sum = 0;
  for (double& x : w) sum += x = unit(random);
  for (double& x : w) x /= sum;
  return w;
}

template <class Points>
Point combination(const Points& points, const std::vector<double>& w) {
  Point p{};
  for (std::size_t i = 0; i < w.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) p[k] += w[i] * points[i][k];
  }
  return p;
}

std::uint64_t seed_of(const Corners& t) {
  std::uint64_t seed = 0x2545f4914f6cdd1dULL;
  for (const Point& p : t) {
    for (const double x : p) seed = (seed ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL + (seed >> 29);
  }
  return seed;
}

}  // namespace

std::vector<Point> SightLines::viewpoints(const exact::ConvexCell& part) const {
  std::vector<Point> corners, found;
  for (const exact::Point3& v : part.vertices()) corners.push_back(exact::to_double_estimate(v));
  const auto keep = [&](const Point& v) {
    const exact::Point3 x = exact::to_exact(v);
    if (exact_cell_.dimension() == 0 ? exact_cell_.contains(x) : exact_cell_.interior_contains(x)) found.push_back(v);
  };
  keep(exact::to_double_estimate(part.center()));
  if (exact_cell_.dimension() == 0) return found;
  std::mt19937_64 random(kViewpoints);
  for (int i = 1; i < kViewpoints; ++i) {
    // From anywhere, and from near the corners, which look farthest round what is in the way.
    std::vector<double> w = weights(corners.size(), random);
    if (i % 2 == 0) {
      for (double& x : w) x *= 0x1p-6;
      w[static_cast<std::size_t>(i / 2) % w.size()] += 1 - 0x1p-6;
    }
    keep(combination(corners, w));
  }
  return found;
}

bool SightLines::reaches_by(SegmentQueries& queries, std::uint32_t triangle, const Point& v, Point p) const {
  const std::uint32_t itself[] = {triangle};
  const Corners t = bvh_.corners(triangle);
  // A little beyond the triangle, so that the line crosses it: from off its plane it can meet it in one way only.
  for (std::size_t c = 0; c < 3; ++c) p[c] += (p[c] - v[c]) * 0x1p-20;
  const FilteredSign side = orient3d_filtered(t[0], t[1], t[2], v);
  if (!side.certain || side.sign == Sign::zero) return false;
  if (mode_ == SideMode::solid && side.sign != kFront) return false;
  const Segment s{v, p};
  return !queries.any_hit(s, {itself, &cell_}) && queries.any_hit(s, {{}, &cell_});
}

bool SightLines::reaches(SegmentQueries& queries, std::uint32_t triangle, const Segment& ray) const {
  const Corners t = bvh_.corners(triangle);
  const Point n = cross_of(minus(t[1], t[0]), minus(t[2], t[0])), way = minus(ray.b, ray.a);
  const double along = dot_of(n, minus(t[0], ray.a)) / dot_of(n, way);
  Point p = ray.a;
  for (std::size_t c = 0; c < 3; ++c) p[c] += along * way[c];
  const bool is_finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  return is_finite && reaches_by(queries, triangle, ray.a, p);
}

std::vector<std::uint8_t> SightLines::reach(const std::vector<std::uint32_t>& triangles, const std::vector<Point>& from,
                                            int tries) const {
  std::vector<std::uint8_t> reached(triangles.size(), 0);
  if (from.empty()) return reached;
  tbb::enumerable_thread_specific<SegmentQueries> all_queries(std::cref(bvh_));
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t k) {
    SegmentQueries& queries = all_queries.local();
    const Corners t = bvh_.corners(triangles[k]);
    std::mt19937_64 random(seed_of(t));
    for (int i = 0; i < tries && reached[k] == 0; ++i) {
      const Point& v = from[random() % from.size()];
      if (reaches_by(queries, triangles[k], v, combination(t, weights(3, random)))) reached[k] = 1;
    }
  });
  return reached;
}

}  // namespace clues::fastpath
