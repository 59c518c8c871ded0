// A view cell cut by a plane (D21): the parts of V on its two sides, as exact cells of V's own dimension.
#pragma once

#include <optional>
#include <vector>

#include "exact/convex_cell.h"

namespace clues::exact {

// The closed part of the cell on that side of the plane (not `on`); none when it has no interior relative to the cell's dimension. O(vertices log vertices),
// and quadratic in the vertices on each side.
std::optional<ConvexCell> part_beside(const ConvexCell& cell, const Plane3& plane, Side side);

// The cell halved across its longest extent (of x, y, z; the first of equal ones). A point cannot be cut: it comes back alone.
std::vector<ConvexCell> halves(const ConvexCell& cell);

}  // namespace clues::exact
