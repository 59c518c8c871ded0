// T2 at a corner: where several walls meet in a mesh vertex y, a walk (D14) may go from one to the next for ever, towards y. If a plane through y has V on one side and all of the
// local face on the other, strictly, then next to y the face is hidden: a parallel plane just beyond y cuts off its tip, which is bounded by the walls and by that plane, with V and the tip on
// one side of it. Nothing enters. Grooves are the same along an edge (walk.h).
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/kernel.h"

namespace clues::reference {

// Whether there is such a plane for the local face at mesh vertex `point` that d points into. False where d lies on a piece. O(k^3) for k cell vertices and pieces at y.
bool is_dark_corner(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t point,
                    const exact::Vector3& d);

// An end of a chain of edges, on one line, in which the two walls of a groove meet: the mesh vertex, and the chain's edge there.
struct GrooveEnd {
  std::uint32_t point = 0, edge = 0;
};

// Whether at these ends of a chain, one or both, the groove that q is in is closed by what is there: with a linear f that is zero on the chain's line, at most zero on V, and positive on all else of the
// border of the local face at an end that is next to the chain's edge in the groove, and nowhere else. It is the same f for all of them. As above.
bool closes_groove(const exact::Complex& complex, const exact::ConvexCell& cell, const std::vector<GrooveEnd>& ends,
                   const exact::Point3& q);

}  // namespace clues::reference
