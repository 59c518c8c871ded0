// Cells that share a face.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::test {

// Both halves of a solid cell, cut at its centre across the x axis: neighbours that share a face. Of a cell without an
// interior none.
std::vector<exact::ConvexCell> halves_of(const exact::ConvexCell& cell);

}  // namespace clues::test
