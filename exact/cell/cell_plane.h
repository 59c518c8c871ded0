// A cell and planes: its facets as polygons, and whether it lies in a plane (T10 is about the wedges whose plane holds all of V).
#pragma once

#include <algorithm>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"

namespace clues::exact {

// Counter-clockwise seen from outside; of a flat cell in the given orientation.
inline std::vector<Point3> corners_of(const ConvexCell& cell, const CellFacet& facet) {
  std::vector<Point3> corners;
  for (const int i : facet.corners) corners.push_back(cell.vertices()[static_cast<std::size_t>(i)]);
  return corners;
}

// Whether all of V lies in the plane; of a solid cell never. O(vertices).
inline bool lies_in(const ConvexCell& cell, const Plane3& plane) {
  return cell.dimension() < 3 &&
         std::all_of(cell.vertices().begin(), cell.vertices().end(), [&](const Point3& v) { return plane.has_on(v); });
}

}  // namespace clues::exact
