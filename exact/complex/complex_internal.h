// The two exact steps of complex.cpp: how two triangles meet, and how a plane full of triangles and contacts is cut.
// Reachable from tests, not installed.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "exact/kernel.h"

namespace clues::exact {

// How two triangles meet: nothing (no points), a point, a segment (two points), or an overlap of positive area in their
// common plane.
struct Contact {
  std::vector<Point3> points;
  bool overlap = false;
};

Contact meet(const Kernel::Triangle_3& a, const Kernel::Triangle_3& b);

// A triangle of the cut plane: its corners, and for each member triangle that contains it whether both face the same way.
struct CutFace {
  std::array<Point3, 3> corners;
  std::vector<std::pair<std::size_t, bool>> owners;
};

// All triangles lie in one plane. O(n log n) plus the crossings of the constraints; every new corner is an exact crossing.
std::vector<CutFace> cut_in_plane(const std::vector<std::array<Point3, 3>>& triangles,
                                  const std::vector<Contact>& contacts);

// Drops the coordinate `axis` (0, 1, 2) of points of a plane that is not parallel to that axis; a bijection on the plane. In units
// of `unit`, a power of two.
Point2 drop_axis(const Point3& p, int axis, double unit = 1);
// And back: the point of the plane that is dropped there. Collapsed.
Point3 lift_axis(const Plane3& plane, const Point2& q, int axis, double unit = 1);
// An axis along which the plane's normal does not vanish (the largest component, as far as intervals can tell).
int dominant_axis(const Vector3& normal);

}  // namespace clues::exact
