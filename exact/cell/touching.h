// Cells of a level and the like: which of them a viewer can go to from which.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::exact {

// For each cell those that no plane of a side of either parts from it, without itself, ascending: all that it has a point
// in common with, and perhaps some that only come near. Cells of dimension 3. O(n^2) for boxes around cells, and
// O(sides * corners) where these meet.
std::vector<std::vector<std::uint32_t>> touching_cells(const std::vector<ConvexCell>& cells);

}  // namespace clues::exact
