// D15: the visibility map. On each side of each piece the valid wedge pieces leave DM segments; they cut it into regions of one label.
#pragma once

#include "exact/scene_query.h"
#include "reference/visibility/first_order.h"
#include "reference/visibility/fixpoint.h"

namespace clues::reference {

// Fills map.regions, map.segments and the counters of regions and walks. Sides that do not count in the mode are left out, and
// so are those that are not `wanted` (per side_index; empty: all are).
void make_regions(const exact::SceneQuery& scene, const Fixpoint& fixpoint, const Options& options,
                  const std::vector<bool>& wanted, VisibilityMap& map);

}  // namespace clues::reference
