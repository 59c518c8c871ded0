// Angles and powers are doubles; they are rounded to the grid before anything is decided by them.
#include "reference/multires/stars/flattening.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clues::reference {
namespace {

using exact::DiskPoint;
constexpr DiskPoint middle{0, 0};

// The parts of the turn that sectors share: from sector `begin` to `end` in ring order they make up `angle`.
struct Side {
  std::size_t begin = 0, end = 0;
  double angle = 0;
};

std::vector<Side> sides_of(const StarShape& shape) {
  const std::size_t sectors = shape.ring.triangles.size();
  switch (shape.kind) {
    case scene::StarKind::interior:
      return {{0, sectors, 2 * std::numbers::pi}};
    case scene::StarKind::boundary:
      return {{0, sectors, std::numbers::pi}};
    case scene::StarKind::feature:
      break;
  }
  return {{0, shape.across, std::numbers::pi}, {shape.across, sectors, std::numbers::pi}};
}

double angle_at(const scene::Point& at, const scene::Point& a, const scene::Point& b) {
  scene::Point u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = a[i] - at[i];
    v[i] = b[i] - at[i];
  }
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return std::atan2(std::sqrt(x * x + y * y + z * z), u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
}

DiskPoint rounded(double radius, double angle) {
  const double unit = static_cast<double>(scene::disk_unit) * radius;
  return {std::llround(unit * std::cos(angle)), std::llround(unit * std::sin(angle))};
}

// Ring vertex k at the direction of all sectors before it. The ends of half turns lie on the axis exactly: the new edge between
// them, on which the vertex comes to lie, must be met without rounding.
FlatStar laid_out(const StarShape& shape, const std::vector<double>& angles, const std::vector<double>& radii) {
  FlatStar flat;
  flat.ring.resize(shape.ring.vertices.size());
  double begun = 0;
  for (const Side& side : sides_of(shape)) {
    double total = 0, run = 0;
    for (std::size_t k = side.begin; k < side.end; ++k) total += angles[k];
    for (std::size_t k = side.begin; k < side.end; ++k) {
      flat.ring[k] = rounded(radii[k], begun + side.angle * (total > 0 ? run / total : 0));
      run += angles[k];
    }
    begun += side.angle;
  }
  const auto on_axis = [&](std::size_t k, int direction) {
    flat.ring[k] = {direction * std::llround(static_cast<double>(scene::disk_unit) * radii[k]), 0};
  };
  if (shape.kind == scene::StarKind::boundary) {
    on_axis(0, 1);
    on_axis(flat.ring.size() - 1, -1);
  } else if (shape.kind == scene::StarKind::feature) {
    on_axis(0, 1);
    on_axis(shape.across, -1);
  }
  return flat;
}

}  // namespace

bool is_certified(const StarShape& shape, const FlatStar& flat) {
  const std::size_t n = flat.ring.size(), sectors = shape.ring.triangles.size();
  int upward = 0;  // across the axis to the right
  for (std::size_t k = 0; k < sectors; ++k) {
    const DiskPoint &p = flat.ring[k], &q = flat.ring[(k + 1) % n];
    if (exact::orientation(middle, p, q) <= 0) return false;
    if (p[1] < 0 && q[1] >= 0) ++upward;
  }
  switch (shape.kind) {
    case scene::StarKind::interior:
      return upward == 1;
    case scene::StarKind::boundary:
      return upward == 0 && flat.ring[0][0] > 0 && flat.ring[0][1] == 0 && flat.ring[n - 1][0] < 0 &&
             flat.ring[n - 1][1] == 0;
    case scene::StarKind::feature:
      break;
  }
  return upward == 1 && flat.ring[0][0] > 0 && flat.ring[0][1] == 0 && flat.ring[shape.across][0] < 0 &&
         flat.ring[shape.across][1] == 0;
}

std::vector<FlatStar> flattenings(const StarShape& shape, std::uint32_t vertex,
                                  const std::vector<scene::Point>& points) {
  const auto& ring = shape.ring.vertices;
  const std::size_t n = ring.size(), sectors = shape.ring.triangles.size();
  for (const Side& side : sides_of(shape)) {
    if (shape.kind != scene::StarKind::interior && side.end - side.begin < 2) return {};
  }
  std::vector<double> angles(sectors), radii(n), ones(n, 1.0), equal(sectors, 1.0);
  double total = 0, longest = 0;
  for (std::size_t k = 0; k < sectors; ++k) {
    angles[k] = angle_at(points[vertex], points[ring[k]], points[ring[(k + 1) % n]]);
    total += angles[k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto &p = points[vertex], &q = points[ring[k]];
    radii[k] = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    longest = std::max(longest, radii[k]);
  }
  // One exponent for both sides of a feature: with two, points of the feature itself would have two images.
  const double turn = shape.kind == scene::StarKind::boundary ? std::numbers::pi : 2 * std::numbers::pi;
  const double exponent = total > 0 ? turn / total : 1;
  for (double& r : radii) r = longest > 0 ? std::pow(r / longest, exponent) : 1;

  std::vector<FlatStar> found;
  for (FlatStar flat : {laid_out(shape, angles, radii), laid_out(shape, angles, ones), laid_out(shape, equal, ones)}) {
    if (is_certified(shape, flat)) found.push_back(std::move(flat));
  }
  return found;
}

}  // namespace clues::reference
