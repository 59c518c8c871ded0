// D18 where all sight lines from p to the cell lie in one plane: a segment as cell, or a polygon in whose
// plane p lies. Directions are then ordered, and what is visible can change only at finitely many. Such a
// cell has no interior in space, so triangles block in it as elsewhere (D3), and a point v that is found has
// all points of the cell near it that see p as well (D6).
#pragma once

#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "exact/sight/point_occlusion.h"

namespace clues::exact {

// p outside the line ab: a point v strictly between a and b, strictly on the positive side of `side`, such that the open segment
// (v,p) meets no triangle, nor do those from all v' near v. O(n^2).
std::optional<Point3> free_point_of_segment(const Point3& p, const std::optional<Plane3>& side, const Point3& a,
                                            const Point3& b, const std::vector<TriangleCorners>& triangles);

// p on the line ab, but not between a and b: the same. Of the segment p sees what lies before the first
// triangle upon it. O(n).
std::optional<Point3> free_point_of_segment_end_on(const Point3& p, const Point3& a, const Point3& b,
                                                   const std::vector<TriangleCorners>& triangles);

// p in the plane of the polygon (corners in cyclic order) and outside of it: v in its relative interior, strictly on the positive
// side, such that (v,p) meets no triangle, nor do those from all v' of the polygon near v. O(n^2).
std::optional<Point3> free_point_of_polygon(const Point3& p, const std::optional<Plane3>& side,
                                            const std::vector<Point3>& polygon,
                                            const std::vector<TriangleCorners>& triangles);

}  // namespace clues::exact
