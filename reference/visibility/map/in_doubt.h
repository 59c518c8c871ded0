// D17b: which triangles are listed for want of an answer, as far as is known.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/search/fixpoint.h"

namespace clues::reference {

// Those of map.visible of which no sight line, free or through a wedge that is known, shows a point; ascending, and none without a fallback.
// `fixpoint` and `map` are of `scene`, and the map has its regions and its list. At most 16 walks for each side.
std::vector<std::uint32_t> find_in_doubt(const exact::SceneQuery& scene, const Fixpoint& fixpoint,
                                         const Options& options, const VisibilityMap& map);

}  // namespace clues::reference
