// T15: convex solids, the surfaces of which block all over. A hull of a level's brush is one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/mesh/bounds.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath::solids {

using scene::Bounds;
using scene::Point;

// Of CGAL::orientation, exactly: 1 where a, b, c turn left seen from d.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

// All x with normal * x <= distance.
struct HalfSpace {
  Point normal{};
  double distance = 0;
  double above(const Point& x) const { return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - distance; }
};

// A side of a convex polytope: its plane is that of three corners, exactly.
struct Side {
  std::array<Point, 3> corners{};  // they turn left seen from outside
  HalfSpace estimate;              // of the inside, with a normal of about unit length

  int side_of(const Point& point) const;  // 1: outside, 0: in the plane, -1: inside; exactly
  // Of all points.
  bool has_none_inside(const std::vector<Point>& points) const;
  bool has_none_outside(const std::vector<Point>& points) const;
  bool has_all_outside(const std::vector<Point>& points) const;
  bool has_all_on(std::span<const Point> points) const;
};
// Three corners that are not collinear, seen from outside. The estimate may be no number where they nearly are.
Side side_through(const Point& a, const Point& b, const Point& c);

// Of a side whose plane is parallel to the two other axes: whether its outside is where coordinates along this axis are larger. Decided exactly.
bool faces_up(const Side& side, std::size_t axis);

struct Solid {
  std::vector<Point> corners;                       // distinct
  std::vector<std::array<std::uint32_t, 2>> edges;  // of its faces, each once
  std::vector<Side> sides;                          // of the planes of all faces, some several times
  Bounds bounds;
};

// The polytope with the given faces, each a polygon that is fanned from its first corner; which way it turns does not matter. None, unless the triangles of the fans lie
// on the surface of the corners' convex hull, which is no flat one, and cover it: decided exactly. O(faces * corners).
std::optional<Solid> solid_of(const std::vector<std::vector<Point>>& given);

}  // namespace clues::fastpath::solids
