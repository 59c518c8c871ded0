// Why the surface is covered: every triangle of positive area lies in a plane that has all corners on one side, so in the surface of their hull, a sphere. All are oriented
// outwards, and where their borders cancel they are a cycle of that sphere, so they cover each of its points equally often; not 0 times, as there is one.
#include "fastpath/solids/solid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "exact/kernel.h"
#include "fastpath/predicates/filter.h"

namespace clues::fastpath::solids {
namespace {

// On which sides of the plane of the three the corners are: -1 or 1, if all that are not on it are on that side; 0, if all are on it; none, if there are some on both.
std::optional<int> side_of_all(const std::array<Point, 3>& plane, const std::vector<Point>& corners) {
  int side = 0;
  for (const Point& p : corners) {
    const int of_p = orientation(plane[0], plane[1], plane[2], p);
    if (of_p == 0) continue;
    if (side != 0 && side != of_p) return std::nullopt;
    side = of_p;
  }
  return side;
}

// Without corners that repeat the one before; none where fewer than three are left: then the face is a segment there and back, and has no border.
std::vector<std::vector<Point>> without_repetitions(const std::vector<std::vector<Point>>& faces) {
  std::vector<std::vector<Point>> out;
  for (auto face : faces) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    while (face.size() > 1 && face.back() == face.front()) face.pop_back();
    if (face.size() >= 3) out.push_back(std::move(face));
  }
  return out;
}

// What of the borders between triangles of a solid are its edges: both corners are in two planes of sides. `on_side`: the corners in the plane of each side, which differ where planes do.
std::vector<std::array<std::uint32_t, 2>> edges_among(const std::map<std::array<std::uint32_t, 2>, int>& borders,
                                                      std::vector<std::vector<std::uint32_t>> on_side) {
  std::sort(on_side.begin(), on_side.end());
  on_side.erase(std::unique(on_side.begin(), on_side.end()), on_side.end());
  std::map<std::uint32_t, std::vector<std::size_t>> planes_at;  // of a corner, ascending
  for (std::size_t plane = 0; plane < on_side.size(); ++plane) {
    for (const auto corner : on_side[plane]) planes_at[corner].push_back(plane);
  }
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::size_t> both;
  for (const auto& [border, count] : borders) {
    const auto &a = planes_at[border[0]], &b = planes_at[border[1]];
    both.clear();
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    if (both.size() >= 2) edges.push_back(border);
  }
  return edges;
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const FilteredSign sign = orient3d_filtered(a, b, c, d, kOrient3dError);
  if (sign.certain) return static_cast<int>(sign.sign);
  return CGAL::orientation(exact::to_exact(a), exact::to_exact(b), exact::to_exact(c), exact::to_exact(d));
}

Side side_through(const Point& a, const Point& b, const Point& c) {
  Point u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  Side side{{a, b, c}, nullptr, {}, {}};
  Point& n = side.estimate.normal;
  for (std::size_t i = 0; i < 3; ++i) n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& x : n) x /= length;
  side.estimate.distance = n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis] || a[axis] != c[axis]) continue;
    Point above = a;
    above[axis] = std::nextafter(above[axis], std::numeric_limits<double>::infinity());
    side.flat = FacetPlane{axis, a[axis], orientation(a, b, c, above) > 0};
  }
  return side;
}

Side side_along(const scene::HalfSpace& inside) {
  Side side;
  side.inside = std::make_shared<const scene::HalfSpace>(inside);
  Point& n = side.estimate.normal;
  mpq_class largest;  // of which normals are as long that no double of it is subnormal
  for (const auto& x : inside.normal) largest = std::max<mpq_class>(largest, abs(x));
  for (std::size_t i = 0; i < 3; ++i) n[i] = mpq_class(inside.normal[i] / largest).get_d();
  const double length = std::hypot(n[0], n[1], n[2]);
  for (double& x : n) x /= length;
  side.estimate.distance = mpq_class(inside.offset / largest).get_d() / length;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (sgn(inside.normal[(axis + 1) % 3]) != 0 || sgn(inside.normal[(axis + 2) % 3]) != 0) continue;
    const mpq_class at = inside.offset / inside.normal[axis];
    if (at == at.get_d()) side.flat = FacetPlane{axis, at.get_d(), sgn(inside.normal[axis]) > 0};
  }
  return side;
}

RoughHeight rough_height(const Point& normal, double distance, const Point& point) {
  double value = -distance, terms = std::fabs(distance);
  for (std::size_t i = 0; i < 3; ++i) {
    value += normal[i] * point[i];
    terms += std::fabs(normal[i] * point[i]);
  }
  return {value, 0x1p-49 * terms + kUnderflow};
}

int rough_side_of(const Point& normal, double distance, const Point& point) {
  const auto [value, error] = rough_height(normal, distance, point);
  if (!(std::fabs(value) > error)) return 0;
  return value > 0 ? 1 : -1;
}

int Side::side_of(const Point& p) const {
  if (flat) {
    const double x = p[flat->axis];
    return x == flat->at ? 0 : (x > flat->at) == flat->outside_is_above ? 1 : -1;
  }
  if (!inside) return orientation(corners[0], corners[1], corners[2], p);
  const int rough = rough_side_of(estimate.normal, estimate.distance, p);
  return rough != 0 ? rough : side_of(scene::to_rational(p));
}

int Side::side_of(const scene::RationalPoint& p) const {
  if (inside) return sgn(inside->height(p));
  return CGAL::orientation(exact::to_exact(corners[0]), exact::to_exact(corners[1]), exact::to_exact(corners[2]),
                           exact::Point3(exact::FT(p[0]), exact::FT(p[1]), exact::FT(p[2])));
}

std::array<mpq_class, 4> Side::exact_plane() const {
  const auto [normal, offset] =
      inside ? *inside
             : scene::plane_through(scene::to_rational(corners[0]), scene::to_rational(corners[1]),
                                    scene::to_rational(corners[2]))
                   .value();
  std::array<mpq_class, 4> numbers{normal[0], normal[1], normal[2], offset};
  const auto first = std::find_if(numbers.begin(), numbers.end() - 1, [](const mpq_class& x) { return sgn(x) != 0; });
  const mpq_class unit = *first;
  for (mpq_class& x : numbers) x /= unit;
  return numbers;
}

bool Side::has_none_inside(const Solid& solid) const {
  if (solid.exact_corners.empty()) return has_none_inside(solid.corners);
  return std::all_of(solid.exact_corners.begin(), solid.exact_corners.end(),
                     [this](const scene::RationalPoint& p) { return side_of(p) >= 0; });
}

bool Side::has_none_inside(const std::vector<Point>& points) const {
  return std::all_of(points.begin(), points.end(), [this](const Point& p) { return side_of(p) >= 0; });
}

bool Side::has_none_outside(const std::vector<Point>& points) const {
  return std::all_of(points.begin(), points.end(), [this](const Point& p) { return side_of(p) <= 0; });
}

bool Side::has_all_outside(const std::vector<Point>& points) const {
  return std::all_of(points.begin(), points.end(), [this](const Point& p) { return side_of(p) > 0; });
}

bool Side::has_all_on(std::span<const Point> points) const {
  return std::all_of(points.begin(), points.end(), [this](const Point& p) { return side_of(p) == 0; });
}

std::optional<Solid> solid_of(const std::vector<std::vector<Point>>& given) {
  const auto faces = without_repetitions(given);
  Solid solid;
  std::map<Point, std::uint32_t> ids;
  for (const auto& face : faces) {
    for (const Point& p : face) {
      if (ids.try_emplace(p, static_cast<std::uint32_t>(solid.corners.size())).second) solid.corners.push_back(p);
    }
  }
  std::map<std::array<std::uint32_t, 2>, int>
      borders;  // from the lower corner to the higher one: how often this way, less how often the other
  for (const auto& face : faces) {
    int outside = 0;  // seen from where the fan turns left
    const std::size_t first = solid.sides.size();
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const std::array<Point, 3> fan{face[0], face[i], face[i + 1]};
      const auto side = side_of_all(fan, solid.corners);
      if (!side || (*side != 0 && outside != 0 && outside != -*side)) return std::nullopt;
      if (*side == 0) continue;
      outside = -*side;
      // A face may be bent outwards between the triangles of its fan.
      if (solid.sides.size() > first && solid.sides.back().has_all_on(fan)) continue;
      if (solid.sides.size() > first) {
        const std::uint32_t a = ids.at(face[0]), b = ids.at(face[i]);
        if (a != b) borders[{std::min(a, b), std::max(a, b)}] += 0;  // an edge that borders nothing
      }
      solid.sides.push_back(*side < 0 ? side_through(fan[0], fan[1], fan[2]) : side_through(fan[0], fan[2], fan[1]));
    }
    if (outside == 0) return std::nullopt;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = ids.at(face[i]), b = ids.at(face[(i + 1) % face.size()]);
      borders[{std::min(a, b), std::max(a, b)}] += a < b ? outside : -outside;
    }
  }
  if (std::any_of(borders.begin(), borders.end(), [](const auto& border) { return border.second != 0; }))
    return std::nullopt;
  if (solid.sides.empty()) return std::nullopt;
  for (const Side& side : solid.sides) {
    auto& on = solid.on_side.emplace_back();
    for (std::uint32_t i = 0; i < solid.corners.size(); ++i) {
      if (side.side_of(solid.corners[i]) == 0) on.push_back(i);
    }
  }
  solid.edges = edges_among(borders, solid.on_side);
  solid.bounds = scene::bounds_of(solid.corners);
  return solid;
}

scene::RationalPoint Solid::exact_corner(std::size_t i) const {
  return exact_corners.empty() ? scene::to_rational(corners[i]) : exact_corners[i];
}

Solid solid_of_polytope(const scene::Polytope& polytope) {
  Solid solid;
  bool rounded = false;
  for (const auto& vertex : polytope.vertices) {
    solid.corners.push_back(scene::to_doubles(vertex));
    rounded = rounded || vertex != scene::to_rational(solid.corners.back());
  }
  solid.bounds = scene::bounds_of(solid.corners);
  if (rounded) {
    solid.exact_corners = polytope.vertices;
    for (std::size_t i = 0; i < 3; ++i) {  // corners are cut off
      constexpr double infinity = std::numeric_limits<double>::infinity();
      solid.bounds.low[i] = std::nextafter(solid.bounds.low[i], -infinity);
      solid.bounds.high[i] = std::nextafter(solid.bounds.high[i], infinity);
    }
  }
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& face : polytope.faces) {
    solid.sides.push_back(side_along(face.half_space));
    auto& on = solid.on_side.emplace_back(face.vertices);
    std::sort(on.begin(), on.end());
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      const auto a = face.vertices[i], b = face.vertices[(i + 1) % face.vertices.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  solid.edges.assign(edges.begin(), edges.end());
  return solid;
}

}  // namespace clues::fastpath::solids
