// Cells that share a face, and a scene to look at from two that do.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"
#include "scene/mesh/mesh.h"

namespace clues::test {

// Both halves of a solid cell, cut at its centre across the x axis: neighbours that share a face. Of a cell without an
// interior none.
std::vector<exact::ConvexCell> halves_of(const exact::ConvexCell& cell);

// A plate below a receiver, under which two cells lie side by side, and an edge of the scene at which what is seen ends.
scene::TriangleMesh plates_and_a_box();

}  // namespace clues::test
