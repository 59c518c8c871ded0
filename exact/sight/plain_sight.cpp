// Everything is redone in plain rationals: that the cell is a closed convex polytope, which points are inside, what a sight line meets.
#include "exact/sight/plain_sight.h"

#include <algorithm>
#include <set>
#include <utility>

namespace clues::exact::plain {
namespace {

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const Vec& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; }

Rational read(const FT& x) { return CGAL::exact(x); }

Vec read(const scene::Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

Bound through(const Vec& normal, const Vec& x) { return {normal, -dot(normal, x)}; }

bool supports(const Bound& bound, const std::vector<Vec>& points) {
  return std::all_of(points.begin(), points.end(), [&](const Vec& x) { return sgn(bound.at(x)) <= 0; });
}

}  // namespace

Vec read(const Point3& p) { return {read(p.x()), read(p.y()), read(p.z())}; }

Rational Bound::at(const Vec& x) const { return dot(normal, x) + offset; }

Cell::Cell(const ConvexCell& cell) { fault_ = read_any(cell); }

// A facet's plane must be outward, hold its corners, and be no other plane than theirs; the polygons must close: then
// their planes are all there are. An empty text when it is so.
std::string Cell::read_solid(const ConvexCell& cell) {
  std::set<std::pair<int, int>> directed;
  for (const CellFacet& facet : cell.facets()) {
    const Bound bound{{read(facet.plane.a()), read(facet.plane.b()), read(facet.plane.c())}, read(facet.plane.d())};
    const std::size_t n = facet.corners.size();
    if (n < 3 || is_zero(bound.normal) || !supports(bound, vertices_))
      return "a facet plane of the cell is not supporting";
    for (std::size_t i = 0; i < n; ++i) {
      const auto corner = [&](std::size_t k) -> const Vec& {
        return vertices_.at(static_cast<std::size_t>(facet.corners[k % n]));
      };
      const Vec turn = cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1));
      if (sgn(bound.at(corner(i))) != 0 || sgn(dot(turn, bound.normal)) <= 0)
        return "a facet of the cell is not in its plane";
      if (!directed.insert({facet.corners[i], facet.corners[(i + 1) % n]}).second)
        return "two facets of the cell overlap";
    }
    bounds_.push_back(bound);
  }
  const bool closed = std::all_of(directed.begin(), directed.end(), [&](const auto& e) {
    return directed.count({e.second, e.first}) == 1;
  });
  return closed && !directed.empty() ? "" : "the facets of the cell do not close";
}

std::string Cell::read_flat(const ConvexCell& cell) {
  const CellFacet& facet = cell.facets().at(0);
  const std::size_t n = facet.corners.size();
  const auto corner = [&](std::size_t k) -> const Vec& {
    return vertices_.at(static_cast<std::size_t>(facet.corners[k % n]));
  };
  const Vec up = cross(corner(1) - corner(0), corner(2) - corner(0));
  flat_.push_back(through(up, corner(0)));
  for (const Vec& x : vertices_) {
    if (is_zero(up) || sgn(flat_[0].at(x)) != 0) return "the cell is not flat";
  }
  span_ = {corner(1) - corner(0), corner(2) - corner(0)};
  for (std::size_t i = 0; i < n; ++i) {
    bounds_.push_back(through(cross(corner(i + 1) - corner(i), up), corner(i)));
    if (!supports(bounds_.back(), vertices_)) return "the flat cell is not convex";
  }
  return "";
}

std::string Cell::read_any(const ConvexCell& cell) {
  for (const Point3& x : cell.vertices()) vertices_.push_back(read(x));
  if (cell.dimension() == 3) return read_solid(cell);
  if (cell.dimension() == 2) return read_flat(cell);
  const Vec& a = vertices_.at(0);
  const Vec along = vertices_.back() - a;
  if (vertices_.size() != static_cast<std::size_t>(cell.dimension()) + 1) return "the cell has too many vertices";
  if (cell.dimension() == 1) {
    if (is_zero(along)) return "the segment that is the cell has no length";
    bounds_ = {through({-along[0], -along[1], -along[2]}, a), through(along, vertices_.back())};
    span_ = {along};
  }
  // x - a is a multiple of `along` (zero for a point) when its cross products with the axes' images vanish.
  for (std::size_t i = 0; i < 3; ++i) {
    Vec axis{0, 0, 0};
    axis[i] = 1;
    flat_.push_back(through(cell.dimension() == 0 ? axis : cross(along, axis), a));
  }
  return "";
}

bool Cell::contains(const Vec& x) const {
  return std::all_of(flat_.begin(), flat_.end(), [&](const Bound& b) { return sgn(b.at(x)) == 0; }) &&
         std::all_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) { return sgn(b.at(x)) <= 0; });
}

bool Cell::interior_contains(const Vec& x) const {
  return std::all_of(flat_.begin(), flat_.end(), [&](const Bound& b) { return sgn(b.at(x)) == 0; }) &&
         std::all_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) { return sgn(b.at(x)) < 0; });
}

std::optional<Cell::Outside> Cell::outside_of(const Vec& v, const Vec& p) const {
  if (!solid()) return Outside{0, false};
  Outside part{1, true};
  for (const Bound& bound : bounds_) {
    const Rational at_p = bound.at(p), at_v = bound.at(v);
    if (sgn(at_p) >= 0) part.begin = std::min(part.begin, Rational(at_v / (at_v - at_p)));
  }
  if (part.begin == 1) return std::nullopt;
  return part;
}

namespace {

Vec normal_of(const std::array<Vec, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

struct SightLine {
  Vec v, direction, moment;  // Pluecker coordinates of the line from v to p
  Cell::Outside part;

  bool holds(const Rational& s) const { return s < 1 && (part.closed ? s >= part.begin : s > part.begin); }

  // The side product with the line from a to b.
  Rational side(const Vec& a, const Vec& b) const { return dot(direction, cross(a, b)) + dot(moment, b - a); }
};

bool blocked_in_plane(const SightLine& line, const std::array<Vec, 3>& t, const Vec& normal) {
  Rational low = line.part.begin, high = 1;
  bool low_in = line.part.closed, high_in = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec inward = cross(normal, t[(i + 1) % 3] - t[i]);
    const Rational at_v = dot(inward, line.v - t[i]), slope = dot(inward, line.direction);
    if (sgn(slope) == 0 && sgn(at_v) < 0) return false;
    if (sgn(slope) == 0) continue;
    const Rational s = -at_v / slope;
    if (sgn(slope) > 0 && s > low) {
      low = s;
      low_in = true;
    } else if (sgn(slope) < 0 && s < high) {
      high = s;
      high_in = true;
    }
  }
  return low < high || (low == high && low_in && high_in);
}

bool blocked(const SightLine& line, const std::array<Vec, 3>& t, const Vec& normal) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int s = sgn(line.side(t[i], t[(i + 1) % 3]));
    left = left || s > 0;
    right = right || s < 0;
  }
  if (left && right) return false;
  if (!left && !right) return blocked_in_plane(line, t, normal);
  // The three side products add up to direction . normal, which is therefore not zero.
  return line.holds(dot(normal, t[0] - line.v) / dot(normal, line.direction));
}

}  // namespace

std::array<Vec, 3> Scene::corners(std::uint32_t triangle) const {
  const scene::Triangle& t = mesh_->triangles[triangle];
  return {read(mesh_->points.at(t[0])), read(mesh_->points.at(t[1])), read(mesh_->points.at(t[2]))};
}

template <class Found>
void Scene::each_blocker(const Vec& v, const Vec& p, const Cell::Outside& part, const Found& found) const {
  const SightLine line{v, p - v, cross(v, p), part};
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
    const std::array<Vec, 3> t = corners(i);
    const Vec n = normal_of(t);
    if (!is_zero(n) && blocked(line, t, n) && found(i)) return;
  }
}

std::optional<std::uint32_t> Scene::blocker(const Vec& v, const Vec& p, const Cell::Outside& part) const {
  std::optional<std::uint32_t> first;
  each_blocker(v, p, part, [&](std::uint32_t t) {
    first = t;
    return true;
  });
  return first;
}

std::vector<std::uint32_t> Scene::blockers(const Vec& v, const Vec& p, const Cell::Outside& part) const {
  std::vector<std::uint32_t> all;
  each_blocker(v, p, part, [&](std::uint32_t t) {
    all.push_back(t);
    return false;
  });
  return all;
}

std::optional<std::uint32_t> Scene::spoiler(const Cell& cell, const Vec& v, const Vec& p) const {
  if (cell.solid()) return std::nullopt;
  const auto along_cell = [&](const Vec& normal) {
    return std::all_of(cell.span().begin(), cell.span().end(), [&](const Vec& d) { return sgn(dot(normal, d)) == 0; });
  };
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
    const std::array<Vec, 3> t = corners(i);
    const Vec n = normal_of(t);
    if (is_zero(n) || sgn(dot(n, v - t[0])) != 0) continue;
    bool holds = true, holds_beside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec inward = cross(n, t[(k + 1) % 3] - t[k]);
      const int side = sgn(dot(inward, v - t[k]));
      holds = holds && side >= 0;
      holds_beside = holds_beside && (side > 0 || along_cell(inward));
    }
    if (!holds) continue;
    const bool off = sgn(dot(n, p - t[0])) != 0;
    if (!along_cell(n) || !(off || holds_beside)) return i;
  }
  return std::nullopt;
}

std::string Scene::flaw_of_target(std::uint32_t triangle, bool front, const Vec& p, const Vec& before,
                                  const char* name_of_before) const {
  if (triangle >= mesh_->triangles.size()) return "there is no triangle " + std::to_string(triangle);
  const std::array<Vec, 3> target = corners(triangle);
  const Vec normal = normal_of(target);
  if (is_zero(normal)) return "triangle " + std::to_string(triangle) + " has no area";
  bool inside = sgn(dot(normal, p - target[0])) == 0;
  for (std::size_t i = 0; i < 3; ++i) {
    inside = inside && sgn(dot(cross(normal, target[(i + 1) % 3] - target[i]), p - target[i])) > 0;
  }
  if (!inside) return "p is not in the relative interior of triangle " + std::to_string(triangle);
  if (sgn(dot(normal, before - target[0])) != (front ? 1 : -1)) {
    return std::string(name_of_before) + " is not strictly on the " + (front ? "front" : "back") +
           " side of triangle " + std::to_string(triangle);
  }
  return "";
}

std::string Scene::flaw_beside(std::uint32_t triangle, const Vec& p) const {
  const Vec normal = normal_of(corners(triangle));
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
    const std::array<Vec, 3> t = corners(i);
    const Vec n = normal_of(t);
    bool touches = !is_zero(cross(n, normal)) && sgn(dot(n, p - t[0])) == 0;
    for (std::size_t k = 0; k < 3; ++k) touches = touches && sgn(dot(cross(n, t[(k + 1) % 3] - t[k]), p - t[k])) >= 0;
    if (touches) {
      return "triangle " + std::to_string(i) + " touches triangle " + std::to_string(triangle) +
             " at p, so that p may be seen with nothing beside it; choose another point";
    }
  }
  return "";
}

}  // namespace clues::exact::plain
