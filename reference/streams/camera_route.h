// D25: the route of a viewer who goes along a recorded path: through which cells, one after the other. All exact; he is in
// the cell of the route at every moment, and where he changes cells in both.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::reference {

// The path is the segments from point to point. Cells may overlap; he stays in one as long as he can, and then takes that
// in which he can stay longest, by way of neighbours that hold the point where he changes. Cells of dimension 3.
// Throws scene::Error bad_argument where the path leaves the cells, with the number of the point before it (from 0).
// O(points * sides of all cells).
std::vector<std::uint32_t> camera_route(const std::vector<exact::ConvexCell>& cells,
                                        const std::vector<std::vector<std::uint32_t>>& neighbours,
                                        const std::vector<exact::Point3>& path);

}  // namespace clues::reference
