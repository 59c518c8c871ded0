// A convex polytope with rational vertices, cut by planes one after the other: the leaves of a BSP tree and the hulls of
// brushes (D23). Every decision is exact.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

using RationalPoint = std::array<mpq_class, 3>;

// The half space normal * x <= offset.
struct HalfSpace {
  RationalPoint normal;
  mpq_class offset;

  // Below 0 inside, 0 on the plane.
  mpq_class height(const RationalPoint& p) const;
  bool holds(const RationalPoint& p) const { return sgn(height(p)) <= 0; }
  HalfSpace opposite() const;
};

// The plane through three points, as the border of a half space whose normal points to where they turn left; none where they are collinear.
std::optional<HalfSpace> plane_through(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c);

struct Polytope {
  struct Face {
    HalfSpace half_space;                 // the polytope lies in it
    std::vector<std::uint32_t> vertices;  // around the face, in either sense; at least three
  };
  std::vector<RationalPoint> vertices;  // each on three faces or more
  std::vector<Face> faces;              // with area

  bool holds(const RationalPoint& p) const;
};

// low < high on every axis.
Polytope box_polytope(const RationalPoint& low, const RationalPoint& high);

// The part in the half space; none where it has no interior. O(size) exact operations.
std::optional<Polytope> intersection(const Polytope& polytope, const HalfSpace& half_space);

RationalPoint to_rational(const Point& p);
// Coordinates are cut off towards zero, by less than a unit in the last place.
Point to_doubles(const RationalPoint& p);

}  // namespace clues::scene
