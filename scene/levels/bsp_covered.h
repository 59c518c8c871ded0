// D22: which sides of hulls are worth their triangles. Whatever blocks may be left out of a scene, since that only ever makes more visible; so nothing
// here has to be exact. A side is *covered* where a drawing that blocks lies on it, or another hull. Nobody in the open stands before a side that is covered
// all over: what it would block, its covers block. Levels consist mostly of such sides, and two screens so close to each other are the most expensive geometry
// that there is for a kernel. A side of which little is open is left out, too: it would stand behind its covers nearly everywhere.
#pragma once

#include <array>
#include <vector>

#include "scene/levels/bsp_hulls.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

// Gaps narrower than this do not count, in units of the level: brushes and drawings of brushes touch to within a fraction of it.
inline constexpr double covered_gap = 0.5;

// How much of a side may be open: so much of it, and no more than this, in square units of the level. A player does not fit through a hole of that size.
inline constexpr double open_share = 0.1, open_area = 64;

// Per hull and face: whether it is covered, but for that little. `drawn` are the triangles that are drawn and block. O(n log n) for n faces and triangles, times
// the number of covers of a face.
std::vector<std::vector<bool>> covered_faces(const std::vector<Hull>& hulls,
                                             const std::vector<std::array<Point, 3>>& drawn);

}  // namespace clues::scene
