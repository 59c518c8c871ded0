// Every expression is part of the rule: its order, and what is rounded on the way.
#include "exact/multires/star_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clues::exact {
namespace {

using Vector = scene::Point;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector product(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(inner(a, a)); }
bool normalize(Vector& a) {
  const double l = length(a);
  if (!(l > 0)) return false;
  for (double& x : a) x /= l;
  return true;
}

// h = (a u^2 + 2 b u v + c v^2) / 2 by least squares over the neighbours.
double curvature(const Vector& at, const Vector& normal, std::span<const std::uint32_t> around,
                 const std::vector<Vector>& points) {
  Vector u = std::abs(normal[0]) < 0.5 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  u = product(normal, u);
  if (!normalize(u)) return 0;
  const Vector v = product(normal, u);
  std::array<std::array<double, 4>, 3> rows{};
  for (const std::uint32_t w : around) {
    const Vector d = difference(points[w], at);
    const double x = inner(d, u), y = inner(d, v), h = inner(d, normal);
    const std::array<double, 4> terms{x * x / 2, x * y, y * y / 2, h};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) rows[i][j] += terms[i] * terms[j];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 3; ++i) {
      if (std::abs(rows[i][k]) > std::abs(rows[best][k])) best = i;
    }
    std::swap(rows[k], rows[best]);
    if (!(std::abs(rows[k][k]) > 0)) return 0;  // fewer than three directions: no quadric, no curvature
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 4; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  const double a = rows[0][3] / rows[0][0], b = rows[1][3] / rows[1][1], c = rows[2][3] / rows[2][2];
  const double mean = (a + c) / 2, apart = std::sqrt((a - c) * (a - c) / 4 + b * b);
  const double kappa = std::abs(mean + apart) + std::abs(mean - apart);
  return std::isfinite(kappa) ? kappa : 0;
}

double angle_at(const Vector& at, const Vector& a, const Vector& b) {
  const Vector u = difference(a, at), v = difference(b, at);
  return std::atan2(length(product(u, v)), inner(u, v));
}

DiskPoint rounded(double radius, double angle) {
  const double unit = static_cast<double>(scene::disk_unit) * radius;
  return {std::llround(unit * std::cos(angle)), std::llround(unit * std::sin(angle))};
}

}  // namespace

std::vector<scene::Point> points_for_estimates(const scene::TriangleMesh& mesh) {
  std::vector<scene::Point> points = mesh.points;
  double largest = 0;
  for (const auto& p : points) {
    for (const double x : p) largest = std::max(largest, std::abs(x));
  }
  if (!(largest > 0)) return points;
  int exponent = 0;
  (void)std::frexp(largest, &exponent);
  Vector low{2, 2, 2}, high{-2, -2, -2};
  for (auto& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = std::ldexp(p[i], -exponent);  // at most 1
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (!(extent > 0)) return points;
  (void)std::frexp(extent, &exponent);
  for (auto& p : points) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = std::ldexp(p[i] - low[i], -exponent);
  }
  return points;
}

StarSize star_size_estimate(std::uint32_t vertex, std::span<const std::uint32_t> star,
                            const std::vector<scene::Triangle>& triangles, const std::vector<scene::Point>& points) {
  StarSize size;
  Vector normal{0, 0, 0};
  boost::container::small_vector<std::uint32_t, 24> around;
  for (const std::uint32_t number : star) {
    const auto& t = triangles[number];
    const Vector n = product(difference(points[t[1]], points[t[0]]), difference(points[t[2]], points[t[0]]));
    size.area += length(n) / 2;
    for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
    for (const std::uint32_t w : t) {
      if (w != vertex) around.push_back(w);  // inner neighbours twice, which is no harm
    }
  }
  if (normalize(normal)) size.kappa = curvature(points[vertex], normal, {around.data(), around.size()}, points);
  return size;
}

double removal_weight_estimate(const StarSize& size, const StarSize& largest) {
  double weight = 0;
  if (largest.area > 0) weight += size.area / largest.area / 2;
  if (largest.kappa > 0) weight += size.kappa / largest.kappa / 2;
  return weight;
}

LayoutProposals::LayoutProposals(scene::StarKind kind, std::uint32_t across, std::uint32_t vertex,
                                 std::span<const std::uint32_t> ring, const std::vector<scene::Point>& points)
    : kind_(kind), across_(across) {
  const std::size_t n = ring.size(), sectors = kind == scene::StarKind::boundary ? n - 1 : n;
  switch (kind) {
    case scene::StarKind::interior:
      side_[0] = {0, sectors, 2 * std::numbers::pi};
      break;
    case scene::StarKind::boundary:
      side_[0] = {0, sectors, std::numbers::pi};
      break;
    case scene::StarKind::feature:
      side_ = {Side{0, across, std::numbers::pi}, Side{across, sectors, std::numbers::pi}};
      sides_ = 2;
      break;
  }
  angles_.resize(sectors);
  radii_.resize(n);
  double total = 0, longest = 0;
  for (std::size_t k = 0; k < sectors; ++k) {
    angles_[k] = angle_at(points[vertex], points[ring[k]], points[ring[(k + 1) % n]]);
    total += angles_[k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto &p = points[vertex], &q = points[ring[k]];
    radii_[k] = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    longest = std::max(longest, radii_[k]);
  }
  // One exponent for both sides of a feature: with two, points of the feature itself would have two images.
  const double turn = kind == scene::StarKind::boundary ? std::numbers::pi : 2 * std::numbers::pi;
  const double exponent = total > 0 ? turn / total : 1;
  for (double& r : radii_) r = longest > 0 ? std::pow(r / longest, exponent) : 1;
}

bool LayoutProposals::possible() const {
  return kind_ == scene::StarKind::interior ||
         std::all_of(side_.begin(), side_.begin() + static_cast<std::ptrdiff_t>(sides_),
                     [](const Side& side) { return side.end - side.begin >= 2; });
}

// Ring vertex k at the direction of all sectors before it. The ends of half turns lie on the axis exactly: the new edge between
// them, on which the vertex comes to lie, must be met without rounding.
void LayoutProposals::lay_out(int proposal, std::span<DiskPoint> out) const {
  const auto radius = [&](std::size_t k) { return proposal == 0 ? radii_[k] : 1.0; };
  const auto angle = [&](std::size_t k) { return proposal < 2 ? angles_[k] : 1.0; };
  double begun = 0;
  for (std::size_t s = 0; s < sides_; ++s) {
    const Side& side = side_[s];
    double total = 0, run = 0;
    for (std::size_t k = side.begin; k < side.end; ++k) total += angle(k);
    for (std::size_t k = side.begin; k < side.end; ++k) {
      out[k] = rounded(radius(k), begun + side.angle * (total > 0 ? run / total : 0));
      run += angle(k);
    }
    begun += side.angle;
  }
  const auto on_axis = [&](std::size_t k, int direction) {
    out[k] = {direction * std::llround(static_cast<double>(scene::disk_unit) * radius(k)), 0};
  };
  if (kind_ == scene::StarKind::boundary) {
    on_axis(0, 1);
    on_axis(out.size() - 1, -1);
  } else if (kind_ == scene::StarKind::feature) {
    on_axis(0, 1);
    on_axis(across_, -1);
  }
}

}  // namespace clues::exact
