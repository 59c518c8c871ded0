// D15: the visibility map. On each side of each piece the valid wedge pieces leave DM segments; they cut it into regions of one label.
#pragma once

#include "exact/sight/scene_query.h"
#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/search/fixpoint.h"

namespace clues::reference {

// Which regions are asked for.
struct RegionScope {
  const std::vector<bool>&
      visited;  // per piece; the others have no visible region and get one hidden region on each side. Empty: all
  const std::vector<bool>& wanted;  // per side_index; the others get no region. Empty: all
};

// Fills map.regions, map.segments and the counters of regions and walks. Sides that do not count in the mode are left out.
void make_regions(const exact::SceneQuery& scene, const Fixpoint& fixpoint, const RegionScope& scope,
                  const Options& options, VisibilityMap& map);

}  // namespace clues::reference
