// T2 at a corner: where several walls meet in a mesh vertex y, a walk (D14) may go from one to the next for ever, towards y. If a plane through y has V on one side and all of the
// local face on the other, strictly, then next to y the face is hidden: a parallel plane just beyond y cuts off its tip, which is bounded by the walls and by that plane, with V and the tip on
// one side of it. Nothing enters. Grooves are the same along an edge (walk.h).
#pragma once

#include <cstdint>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/kernel.h"

namespace clues::reference {

// Whether there is such a plane for the local face at mesh vertex `point` that d points into. False where d lies on a piece. O(k^3) for k cell vertices and pieces at y.
bool is_dark_corner(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t point,
                    const exact::Vector3& d);

}  // namespace clues::reference
