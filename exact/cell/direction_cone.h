// D18: convex cones of directions at a point, as the oracle needs them: cut by a plane, and one taken away from another.
// A cone is a cyclic list of inward normals; its extreme rays are cross products of neighbours, so that numbers do not grow
// with the number of cuts.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "exact/kernel.h"

namespace clues::exact {

// A pointed cone with interior. Edge i lies in the plane normals[i] and runs from rays[i] to rays[i+1]; the order is such that
// normals[i] is a positive multiple of rays[i] x rays[i+1].
struct DirectionCone {
  std::vector<Vector3> normals;
  std::vector<Vector3> rays;
};

// The cone of a strictly convex planar polygon seen from p; nullopt when it has no interior (p in its plane, fewer than 3 corners).
std::optional<DirectionCone> cone_of(const std::vector<Point3>& polygon, const Point3& p);

// The part with normal . d >= 0; nullopt when it has no interior. O(edges).
std::optional<DirectionCone> clipped(const DirectionCone& cone, const Vector3& normal);

// Convex cones with disjoint interiors whose union is the closure of `cone` minus `taken`.
std::vector<DirectionCone> difference(const DirectionCone& cone, const DirectionCone& taken);

// Whether the closed cone holds d.
bool contains(const DirectionCone& cone, const Vector3& d);

// How many extreme rays of `inner` lie in the closed `outer`.
std::size_t rays_inside(const DirectionCone& inner, const DirectionCone& outer);

// A direction in the interior, another for each t = 1, 2, ...; for any plane all but finitely many t give one outside the plane.
Vector3 interior_direction(const DirectionCone& cone, int t);

// The part of a strictly convex polygon on the closed positive side of a plane; strictly convex, perhaps fewer than 3 corners.
std::vector<Point3> clipped(const std::vector<Point3>& polygon, const Plane3& plane);

}  // namespace clues::exact
