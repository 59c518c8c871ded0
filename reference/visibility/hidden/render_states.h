// FIG. 21C: what a renderer may leave out for a region of the map, as long as the viewpoint is in the cell. Repaired (hazard A-1): each label stands for itself,
// counts all surfaces of the scene, and is given only where the whole shaft between region and cell proves it.
//
// The shaft of a region is the open convex hull of the region and of the part of the cell in front of it; it contains all its sight lines.
#pragma once

#include <string>
#include <vector>

#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

struct RenderState {
  bool no_z_compare = false;  // no surface meets its shaft: from every viewpoint all of it is seen, so it always wins
  bool no_z_write =
      false;  // it does not meet the shaft of any other visible region: nothing that is drawn lies behind it. What is not in the
  // scene (a sky, moving things) must be drawn so that it does not need its depth. It may still need to be compared.
  bool no_backface_cull = false;  // all of the cell is strictly in front of it
};

// Per region of the map; hidden regions have no labels. For r visible regions and n pieces: r hulls and O(r (r + n)) box tests.
std::vector<RenderState> render_states(const VisibilityMap& map);

// The names of FIG. 21C that hold, in alphabetical order.
std::vector<std::string> names_of(const RenderState& state);

}  // namespace clues::reference
