// D19 without `undecided`: what a judgement left open in a small scene is decided by the exact visible set (visible_set.h).
#pragma once

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

// Scenes of up to so many triangles are settled in about a second (docs/visible-set.md).
inline constexpr std::size_t kSettleTriangles = 60;

// Every triangle in Omega without a witness gets a witness, or is proved hidden (Judgement::proved_hidden). Does nothing when none is open. A triangle whose
// search reaches its limit stays open; there is no limit by default. Same scene, cell and mode as the judgement.
void settle(Judgement& judgement, const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, reference::Mode mode);

}  // namespace clues::validate
