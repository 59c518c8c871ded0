// Cells within others whose corners are doubles, as files of contours have them.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::test {

// The halves of a solid cell; where their corners are no doubles, a box in each half instead. Of another cell none.
std::vector<exact::ConvexCell> inner_cells_of(const exact::ConvexCell& cell);

}  // namespace clues::test
