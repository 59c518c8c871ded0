// A cell in a plane: T10 is about the wedges whose plane holds all of V.
#pragma once

#include <algorithm>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"

namespace clues::exact {

// Whether all of V lies in the plane; of a solid cell never. O(vertices).
inline bool lies_in(const ConvexCell& cell, const Plane3& plane) {
  return cell.dimension() < 3 &&
         std::all_of(cell.vertices().begin(), cell.vertices().end(), [&](const Point3& v) { return plane.has_on(v); });
}

}  // namespace clues::exact
