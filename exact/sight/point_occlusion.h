// D18, the point-occlusion oracle: one point p against the whole cell V. The shadow of a triangle is the
// closure of the set of all v in int V from which the triangle stops the sight line to p (D5). p is occluded
// exactly when the shadows cover int V. What they leave is open in int V, so p is then seen from an open part
// of it, as D6 asks, and that part holds a rational sight line, which is returned.
//
// Seen from p the triangles are convex cones; a solid cell and a polygon are others. The cones of the parts
// of the triangles that lie between p and V are subtracted from that of V, exactly. Where all sight lines lie
// in one plane, directions are ordered instead (planar_occlusion.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"

namespace clues::exact {

struct OcclusionAnswer {
  bool occluded = false;
  std::optional<Point3>
      witness;  // not occluded: v in int V such that (v,p) is free (D5), and so for all v' of int V near v
};

// A triangle soup seen by the oracle: exact corners. Degenerate triangles must have been dropped.
using TriangleCorners = std::array<Point3, 3>;

// `side`: when p lies on a surface and is asked for on one side of it, the plane whose positive side v must lie
// strictly on (D14 rule 3); std::nullopt for a point of free space. Triangles that contain p are ignored when `side` is given
// and lie in that plane; otherwise a triangle containing p occludes by D5 only where it lies between p and v.
// A point of the closed V is not occluded (D3); it comes without a witness where V has no point strictly on
// the positive side, and if V is not solid. O(n) segment
// tests for each piece that a shadow has to be cut from; with many triangles pass only those that can matter.
// Throws Error bad_argument when p is not in the plane `side`.
OcclusionAnswer point_occlusion(const Point3& p, const std::optional<Plane3>& side, const ConvexCell& cell,
                                const std::vector<TriangleCorners>& triangles);

}  // namespace clues::exact
