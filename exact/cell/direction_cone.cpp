// Convex cones of directions (D18): clipping and subtraction.
#include "exact/cell/direction_cone.h"

#include <algorithm>
#include <utility>

namespace clues::exact {
namespace {

CGAL::Sign side_of(const Vector3& normal, const Vector3& d) { return CGAL::sign(CGAL::scalar_product(normal, d)); }

}  // namespace

std::optional<DirectionCone> cone_of(const std::vector<Point3>& polygon, const Point3& p) {
  if (polygon.size() < 3) return std::nullopt;
  DirectionCone cone;
  for (const Point3& corner : polygon) cone.rays.push_back(corner - p);
  const CGAL::Sign turn = side_of(CGAL::cross_product(cone.rays[0], cone.rays[1]), cone.rays[2]);
  if (turn == CGAL::ZERO) return std::nullopt;
  if (turn == CGAL::NEGATIVE) std::reverse(cone.rays.begin(), cone.rays.end());
  for (std::size_t i = 0; i < cone.rays.size(); ++i) {
    cone.normals.push_back(CGAL::cross_product(cone.rays[i], cone.rays[(i + 1) % cone.rays.size()]));
  }
  return cone;
}

std::optional<DirectionCone> clipped(const DirectionCone& cone, const Vector3& normal) {
  const std::size_t n = cone.rays.size();
  std::vector<CGAL::Sign> sides;
  bool any_positive = false, any_negative = false;
  for (const Vector3& ray : cone.rays) {
    sides.push_back(side_of(normal, ray));
    any_positive = any_positive || sides.back() == CGAL::POSITIVE;
    any_negative = any_negative || sides.back() == CGAL::NEGATIVE;
  }
  if (!any_positive) return std::nullopt;
  if (!any_negative) return cone;
  // The edges with a point on the positive side form one arc; `normal` closes it.
  const auto kept = [&](std::size_t i) {
    return sides[i % n] == CGAL::POSITIVE || sides[(i + 1) % n] == CGAL::POSITIVE;
  };
  // The arc begins where the sides turn positive, so also where a single ray is negative and every edge is kept.
  std::size_t first = 0;
  while (sides[first] == CGAL::POSITIVE || sides[(first + 1) % n] != CGAL::POSITIVE) ++first;
  DirectionCone part;
  for (std::size_t i = first; i < first + n && kept(i); ++i) part.normals.push_back(cone.normals[i % n]);
  part.normals.push_back(normal);
  const std::size_t m = part.normals.size();
  for (std::size_t i = 0; i < m; ++i) {
    part.rays.push_back(CGAL::cross_product(part.normals[(i + m - 1) % m], part.normals[i]));
  }
  return part;
}

std::vector<DirectionCone> difference(const DirectionCone& cone, const DirectionCone& taken) {
  std::vector<DirectionCone> pieces;
  DirectionCone rest = cone;
  for (const Vector3& normal : taken.normals) {
    if (auto outside = clipped(rest, -normal)) pieces.push_back(std::move(*outside));
    auto inside = clipped(rest, normal);
    if (!inside) return {cone};  // nothing in common: do not cut
    rest = std::move(*inside);
  }
  return pieces;
}

bool contains(const DirectionCone& cone, const Vector3& d) {
  return std::all_of(cone.normals.begin(), cone.normals.end(),
                     [&](const Vector3& normal) { return side_of(normal, d) != CGAL::NEGATIVE; });
}

std::size_t rays_inside(const DirectionCone& inner, const DirectionCone& outer) {
  return static_cast<std::size_t>(
      std::count_if(inner.rays.begin(), inner.rays.end(), [&](const Vector3& ray) { return contains(outer, ray); }));
}

Vector3 interior_direction(const DirectionCone& cone, int t) {
  Vector3 sum(0, 0, 0);
  FT weight(1);
  for (const Vector3& ray : cone.rays) {
    sum = sum + ray * weight;
    weight *= t;
  }
  return sum;
}

std::vector<Point3> clipped(const std::vector<Point3>& polygon, const Plane3& plane) {
  std::vector<Point3> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const FT at_a = value_at(plane, a), at_b = value_at(plane, b);
    if (CGAL::sign(at_a) != CGAL::NEGATIVE) part.push_back(a);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) == CGAL::NEGATIVE) part.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return part;
}

}  // namespace clues::exact
