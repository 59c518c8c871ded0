// T15: convex solids, the surfaces of which block all over: parts of a mesh, or the brushes of a level, which have rational corners.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/levels/polytope.h"
#include "scene/mesh/bounds.h"
#include "scene/mesh/mesh.h"

namespace clues::fastpath::solids {

using scene::Bounds;
using scene::Point;

inline constexpr double kUnderflow = 0x1p-1000;  // more than is lost of products that are too small for doubles

// Of CGAL::orientation, exactly: 1 where a, b, c turn left seen from d.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

// All x with normal * x <= distance.
struct HalfSpace {
  Point normal{};
  double distance = 0;
  double above(const Point& x) const { return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - distance; }
};

// normal * point - distance, and how wrong that may be. Coordinates, or the numbers of the plane, may be off by 2^-51 of themselves: with seven roundings that is less than 2^-49 of the terms.
struct RoughHeight {
  double value = 0, error = 0;
};
RoughHeight rough_height(const Point& normal, double distance, const Point& point);

// On which side of the plane normal * x = distance a point is, -1 or 1; 0 where doubles do not tell.
int rough_side_of(const Point& normal, double distance, const Point& point);

// A plane that is parallel to two axes: exactly one coordinate, and on which side of it is the outside of what it bounds.
struct FacetPlane {
  std::size_t axis = 0;
  double at = 0;
  bool outside_is_above = true;
  std::array<double, 3> key() const { return {static_cast<double>(axis), at, outside_is_above ? 1.0 : 0.0}; }
};

struct Solid;

// A side of a convex polytope: its plane is that of three corners, exactly, or one with rational numbers.
struct Side {
  std::array<Point, 3> corners{};                  // they turn left seen from outside; of no meaning if there is
  std::shared_ptr<const scene::HalfSpace> inside;  // this: exactly what is inside
  HalfSpace estimate;                              // of the inside, with a normal of about unit length
  std::optional<FacetPlane> flat;                  // its plane, where that is such a one
  std::int32_t plane = -1;                         // sides in the same plane have the same number; -1: not known

  int side_of(const Point& point) const;  // 1: outside, 0: in the plane, -1: inside; exactly
  int side_of(const scene::RationalPoint& point) const;
  // Coefficients of its plane a x + b y + c z = d, of which the first that is not 0 is 1: the same for sides in the same plane.
  std::array<mpq_class, 4> exact_plane() const;
  // Of all points, or of all corners of the solid.
  bool has_none_inside(const std::vector<Point>& points) const;
  bool has_none_inside(const Solid& solid) const;
  bool has_none_outside(const std::vector<Point>& points) const;
  bool has_all_outside(const std::vector<Point>& points) const;
  bool has_all_on(std::span<const Point> points) const;
};
// Three corners that are not collinear, seen from outside. The estimate may be no number where they nearly are.
Side side_through(const Point& a, const Point& b, const Point& c);
Side side_along(const scene::HalfSpace& inside);

struct Solid {
  std::vector<Point> corners;                       // distinct
  std::vector<scene::RationalPoint> exact_corners;  // of these, where they are rounded; else empty
  std::vector<std::array<std::uint32_t, 2>> edges;  // each once; none where parts of one face meet
  std::vector<Side> sides;                          // of the planes of all faces, some several times
  std::vector<std::vector<std::uint32_t>> on_side;  // per side: numbers of the corners in its plane, ascending
  Bounds bounds;                                    // all of it is in there

  scene::RationalPoint exact_corner(std::size_t i) const;
};

// The polytope with the given faces, each a polygon that is fanned from its first corner; which way it turns does not matter. None, unless the triangles of the fans lie
// on the surface of the corners' convex hull, which is no flat one, and cover it: decided exactly. O(faces * corners).
std::optional<Solid> solid_of(const std::vector<std::vector<Point>>& given);
Solid solid_of_polytope(const scene::Polytope& polytope);

}  // namespace clues::fastpath::solids
