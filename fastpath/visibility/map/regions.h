// The regions of one label on the sides of a small scene (D15): estimates in doubles, for areas and pictures.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fastpath/visibility/map/local_map.h"
#include "fastpath/visibility/scene/local_scene.h"
#include "fastpath/visibility/wedges/piece_set.h"

namespace clues::fastpath {

// Whether the front (back) of a piece is a side of this triangle that the mode counts (D4).
bool counts_for(SideMode mode, const LocalOrigin& o, bool front);

using RegionIsVisible = std::function<bool(std::span<const IntervalBox>, const ExactPoint&)>;

// Of the wanted triangles. `visible` is asked about enclosures of a region's corners and a point beside it. O(k^2) parts on a side that k valid pieces cross.
std::vector<LocalRegion> make_regions(const LocalScene& scene, const PieceSet& pieces, SideMode mode,
                                      const std::vector<bool>& wanted, const RegionIsVisible& visible);

}  // namespace clues::fastpath
