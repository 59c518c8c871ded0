// D18 where all sight lines from p to the cell lie in one plane: a segment as cell, a polygon in whose plane p lies, or a crease
// that triangles make on a flat cell. Directions are then ordered, and what is visible can change only at finitely many.
#pragma once

#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "exact/point_occlusion.h"

namespace clues::exact {

// p outside the line ab: a point v strictly between a and b, strictly on the positive side of `side`, such that the open segment
// (v,p) meets no triangle. Complete: single free points v count. O(n^2).
std::optional<Point3> free_point_of_segment(const Point3& p, const std::optional<Plane3>& side, const Point3& a,
                                            const Point3& b, const std::vector<TriangleCorners>& triangles);

// p in the plane of the polygon (corners in cyclic order) and outside of it: v in its relative interior, strictly on the positive
// side, such that (v,p) meets no triangle outside the relative interior. O(n^2).
std::optional<Point3> free_point_of_polygon(const Point3& p, const std::optional<Plane3>& side,
                                            const std::vector<Point3>& polygon,
                                            const std::vector<TriangleCorners>& triangles);

}  // namespace clues::exact
