// D15: the visibility map. On each side of each piece the valid wedge pieces leave DM segments; they cut it into regions of one label.
#pragma once

#include "exact/scene_query.h"
#include "reference/visibility/first_order.h"
#include "reference/visibility/fixpoint.h"

namespace clues::reference {

// Fills map.regions, map.segments and the counters of regions and walks. Sides that do not count in the mode are left out. `visited`, if not empty,
// says which pieces may have a visible region; the others get one hidden region on each side.
void make_regions(const exact::SceneQuery& scene, const Fixpoint& fixpoint, const std::vector<bool>& visited,
                  const Options& options, VisibilityMap& map);

}  // namespace clues::reference
