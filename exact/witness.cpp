// The witness checker (D5, D6, D18). It reads coordinates and redoes everything in plain rationals: that the cell it is given is
// a closed convex polytope, that v is inside, that p is on the triangle, and that no triangle meets the sight line.
#include "exact/witness.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace clues::exact {
namespace {

using Rational = mpq_class;
using Vec = std::array<Rational, 3>;

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const Vec& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; }

Rational read(const FT& x) { return Rational(to_string_exact(x)); }

Vec read(const Point3& p) { return {read(p.x()), read(p.y()), read(p.z())}; }

Vec read(const scene::Point& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

// A constraint on V: the points with value <= 0; the boundary has value 0.
struct Bound {
  Vec normal;
  Rational offset;
  Rational at(const Vec& x) const { return dot(normal, x) + offset; }
};

// V as int V = {all bounds < 0}, within the flat when it is lower-dimensional.
struct Cell {
  std::vector<Vec> vertices;
  std::vector<Bound> flat;  // equations of the affine hull, each zero
  std::vector<Bound> bounds;
};

Bound through(const Vec& normal, const Vec& x) { return {normal, -dot(normal, x)}; }

bool supports(const Bound& bound, const std::vector<Vec>& points) {
  return std::all_of(points.begin(), points.end(), [&](const Vec& x) { return sgn(bound.at(x)) <= 0; });
}

// A facet's plane must be outward, hold its corners, and be no other plane than theirs; the polygons must close: then
// their planes are all there are. An empty text when it is so.
std::string read_solid(const ConvexCell& cell, Cell& out) {
  std::set<std::pair<int, int>> directed;
  for (const CellFacet& facet : cell.facets()) {
    const Bound bound{{read(facet.plane.a()), read(facet.plane.b()), read(facet.plane.c())}, read(facet.plane.d())};
    const std::size_t n = facet.corners.size();
    if (n < 3 || is_zero(bound.normal) || !supports(bound, out.vertices))
      return "a facet plane of the cell is not supporting";
    for (std::size_t i = 0; i < n; ++i) {
      const auto corner = [&](std::size_t k) -> const Vec& {
        return out.vertices.at(static_cast<std::size_t>(facet.corners[k % n]));
      };
      const Vec turn = cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1));
      if (sgn(bound.at(corner(i))) != 0 || sgn(dot(turn, bound.normal)) <= 0)
        return "a facet of the cell is not in its plane";
      if (!directed.insert({facet.corners[i], facet.corners[(i + 1) % n]}).second)
        return "two facets of the cell overlap";
    }
    out.bounds.push_back(bound);
  }
  const bool closed = std::all_of(directed.begin(), directed.end(), [&](const auto& e) {
    return directed.count({e.second, e.first}) == 1;
  });
  return closed && !directed.empty() ? "" : "the facets of the cell do not close";
}

std::string read_flat(const ConvexCell& cell, Cell& out) {
  const CellFacet& facet = cell.facets().at(0);
  const std::size_t n = facet.corners.size();
  const auto corner = [&](std::size_t k) -> const Vec& {
    return out.vertices.at(static_cast<std::size_t>(facet.corners[k % n]));
  };
  const Vec up = cross(corner(1) - corner(0), corner(2) - corner(0));
  out.flat.push_back(through(up, corner(0)));
  for (const Vec& x : out.vertices) {
    if (is_zero(up) || sgn(out.flat[0].at(x)) != 0) return "the cell is not flat";
  }
  for (std::size_t i = 0; i < n; ++i) {
    out.bounds.push_back(through(cross(corner(i + 1) - corner(i), up), corner(i)));
    if (!supports(out.bounds.back(), out.vertices)) return "the flat cell is not convex";
  }
  return "";
}

std::string read_cell(const ConvexCell& cell, Cell& out) {
  for (const Point3& x : cell.vertices()) out.vertices.push_back(read(x));
  if (cell.dimension() == 3) return read_solid(cell, out);
  if (cell.dimension() == 2) return read_flat(cell, out);
  const Vec& a = out.vertices.at(0);
  const Vec along = out.vertices.back() - a;
  if (cell.dimension() == 1) {
    out.bounds = {through({-along[0], -along[1], -along[2]}, a), through(along, out.vertices.back())};
  }
  // x - a is a multiple of `along` (zero for a point) when its cross products with the axes' images vanish.
  for (std::size_t i = 0; i < 3; ++i) {
    Vec axis{0, 0, 0};
    axis[i] = 1;
    out.flat.push_back(through(cell.dimension() == 0 ? axis : cross(along, axis), a));
  }
  return "";
}

bool strictly_inside(const Cell& cell, const Vec& x) {
  return std::all_of(cell.flat.begin(), cell.flat.end(), [&](const Bound& b) { return sgn(b.at(x)) == 0; }) &&
         std::all_of(cell.bounds.begin(), cell.bounds.end(), [&](const Bound& b) { return sgn(b.at(x)) < 0; });
}

// The part v + s (p - v), begin <= s < 1 (begin < s when !closed), of the sight line outside int V.
struct Outside {
  Rational begin = 0;
  bool closed = false;
};

std::optional<Outside> outside_of(const Cell& cell, const Vec& v, const Vec& p) {
  if (std::any_of(cell.flat.begin(), cell.flat.end(), [&](const Bound& b) { return sgn(b.at(p)) != 0; })) {
    return Outside{0, false};  // leaves the flat at once: only v is in int V
  }
  Outside part{1, true};
  for (const Bound& bound : cell.bounds) {
    const Rational at_p = bound.at(p), at_v = bound.at(v);
    if (sgn(at_p) >= 0) part.begin = std::min(part.begin, Rational(at_v / (at_v - at_p)));
  }
  if (part.begin == 1) return std::nullopt;
  return part;
}

struct Line {
  Vec v, direction, moment;  // Pluecker coordinates of the line from v to p
  Outside part;

  bool holds(const Rational& s) const { return s < 1 && (part.closed ? s >= part.begin : s > part.begin); }

  // The side product with the line from a to b.
  Rational side(const Vec& a, const Vec& b) const { return dot(direction, cross(a, b)) + dot(moment, b - a); }
};

bool blocked_in_plane(const Line& line, const std::array<Vec, 3>& t, const Vec& normal) {
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

bool blocked(const Line& line, const std::array<Vec, 3>& t, const Vec& normal) {
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

std::array<Vec, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t i) {
  const scene::Triangle& t = mesh.triangles[i];
  return {read(mesh.points.at(t[0])), read(mesh.points.at(t[1])), read(mesh.points.at(t[2]))};
}

Vec normal_of(const std::array<Vec, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

// The triangles that meet the open segment (v,p) outside int V; or just the first.
std::vector<std::uint32_t> blockers_of(const scene::TriangleMesh& mesh, const Cell& cell, const Vec& v, const Vec& p,
                                       bool one) {
  std::vector<std::uint32_t> blockers;
  const std::optional<Outside> outside = outside_of(cell, v, p);
  if (!outside) return blockers;  // all of (v,p) is in int V
  const Line line{v, p - v, cross(v, p), *outside};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<Vec, 3> t = corners_of(mesh, i);
    const Vec n = normal_of(t);
    if (is_zero(n) || !blocked(line, t, n)) continue;
    blockers.push_back(i);
    if (one) break;
  }
  return blockers;
}

WitnessVerdict refuse(std::string reason) { return {false, std::move(reason)}; }

}  // namespace

WitnessVerdict check_witness(const scene::TriangleMesh& mesh, const ConvexCell& cell, std::uint32_t triangle,
                             bool front, const Point3& v_point, const Point3& p_point) {
  if (triangle >= mesh.triangles.size()) return refuse("there is no triangle " + std::to_string(triangle));
  const auto corners = [&](std::uint32_t i) { return corners_of(mesh, i); };
  const Vec v = read(v_point), p = read(p_point);

  const std::array<Vec, 3> target = corners(triangle);
  const Vec normal = normal_of(target);
  if (is_zero(normal)) return refuse("triangle " + std::to_string(triangle) + " has no area");
  bool inside = sgn(dot(normal, p - target[0])) == 0;
  for (std::size_t i = 0; i < 3; ++i) {
    inside = inside && sgn(dot(cross(normal, target[(i + 1) % 3] - target[i]), p - target[i])) > 0;
  }
  if (!inside) return refuse("p is not in the relative interior of triangle " + std::to_string(triangle));
  if (sgn(dot(normal, v - target[0])) != (front ? 1 : -1)) {
    return refuse(std::string("v is not strictly on the ") + (front ? "front" : "back") + " side of triangle " +
                  std::to_string(triangle));
  }

  Cell own;
  if (std::string fault = read_cell(cell, own); !fault.empty()) return refuse(std::move(fault));
  if (!strictly_inside(own, v)) return refuse("v is not in the relative interior of the cell");
  const std::vector<std::uint32_t> blockers = blockers_of(mesh, own, v, p, true);
  if (!blockers.empty()) return refuse("triangle " + std::to_string(blockers[0]) + " blocks the sight line");
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<Vec, 3> t = corners(i);
    const Vec n = normal_of(t);
    bool touches = !is_zero(cross(n, normal)) && sgn(dot(n, p - t[0])) == 0;
    for (std::size_t k = 0; k < 3; ++k) touches = touches && sgn(dot(cross(n, t[(k + 1) % 3] - t[k]), p - t[k])) >= 0;
    if (touches) {
      return refuse("triangle " + std::to_string(i) + " touches triangle " + std::to_string(triangle) +
                    " at p, so that p may be seen with nothing beside it; choose another point");
    }
  }
  return {true, ""};
}

SightLine check_sight_line(const scene::TriangleMesh& mesh, const ConvexCell& cell, const Point3& v_point,
                           const Point3& p_point) {
  SightLine out;
  const Vec v = read(v_point), p = read(p_point);
  Cell own;
  if (!read_cell(cell, own).empty() || !strictly_inside(own, v) || is_zero(p - v)) return out;
  out.valid = true;
  out.blockers = blockers_of(mesh, own, v, p, false);
  return out;
}

}  // namespace clues::exact
