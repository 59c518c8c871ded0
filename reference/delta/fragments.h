// The visible regions of a map (D15) as a mesh: what a renderer draws in place of the scene, or a server sends. Each
// fragment knows its region, and so the triangle of the scene; it is counter-clockwise as seen from the side that is
// seen. A surface that is seen from both sides has fragments for both.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/delta/sewn_mesh.h"
#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

// The region's rings, counter-clockwise from its own side: those of a map always turn as the front does.
Rings3 rings_from_its_side(const Region& region);

struct FragmentMesh {
  SewnMesh mesh;                       // its regions are places in `regions`
  std::vector<std::uint64_t> regions;  // of the map, ascending: the visible ones
};

// In the coordinates of the map. As sew().
FragmentMesh visible_fragments(const VisibilityMap& map);

}  // namespace clues::reference
