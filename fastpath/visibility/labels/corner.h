// T2 at a corner: where several walls meet in a mesh vertex y, a walk (D14) may go from one to the next for ever, towards y. If a plane through y has V on one side and all of the local
// face on the other, strictly, then next to y the face is hidden: a parallel plane just beyond y cuts off its tip, bounded by the walls and by that plane, with V and the tip on one side of
// it, and nothing enters (docs/definition.md, section 6).
#pragma once

#include <cstdint>
#include <span>

#include "fastpath/visibility/scene/local_scene.h"

namespace clues::fastpath {

// Whether there is such a plane for the local face at mesh vertex `point` that holds the way to q. By whole numbers; false where the vertex is too intricate. O(k^3) for k cell vertices
// and pieces at y.
bool is_dark_corner(const LocalScene& scene, std::uint32_t point, const ExactPoint& q);

// An end of a chain of edges, on one line, in which the two walls of a groove meet: the mesh vertex, and the chain's edge there.
struct GrooveEnd {
  std::uint32_t point = 0, edge = 0;
};

// Whether at these ends of a chain, one or both, the groove that q is in is closed by what is there: with a linear f that is zero on the chain's line, at most zero on V, and positive on all else of
// the border of the local face at an end that is next to the chain's edge in the groove, and nowhere else; the same for all of them (reference/visibility/labels/walk.h has the argument). Exact and costly as above.
bool closes_groove(const LocalScene& scene, std::span<const GrooveEnd> ends, const ExactPoint& q);

}  // namespace clues::fastpath
