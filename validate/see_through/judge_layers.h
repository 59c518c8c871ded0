// D19 for scenes in which some triangles do not block or do not count (D22): the judge's verdicts, layer by layer (layers.h). A
// sight line that is free of a layer is free of what blocks, so its witnesses are witnesses of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/flagged_mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

struct SeeThroughJudgement {
  Judgement judgement;  // per triangle of the scene, with chains. What does not count is `hidden`, listed or not.
  std::vector<std::array<exact::FT, 2>> first_order_fractions;  // as in measures.h, of the layer that decided
  std::uint64_t layers = 0;
};

// `pvs` is ascending. Small layers are settled (settle.h).
SeeThroughJudgement judge_see_through(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                      const std::vector<std::uint32_t>& pvs, const reference::Options& options);

}  // namespace clues::validate
