// Where the pieces of an overlay crowd, its points are moved apart (D33, D34). A new line through pieces as thin as the grid of 2^-60 has nowhere to put its points; but the map between is
// free: any places of the points on the two surfaces will do at which every piece keeps its orientation on both. So a point of the overlay goes towards the middle of its neighbours, on the base
// domain and on the input, each time within the triangle or along the edge that it lies in, and only where the smallest of the pieces around it grows by that or has room.
#pragma once

#include <cstdint>
#include <set>

#include "scene/multires/hierarchy.h"

namespace clues::reference {

// Around the pieces in these base triangles. Vertices of the input stay where they are on the input, and what lies on an edge of it (a feature, say) stays on that. The map becomes another one, a
// homeomorphism as before. `hierarchy` has to be a verified one. O(pieces) and a few rounds over those of these triangles.
void make_room(scene::Hierarchy& hierarchy, const std::set<std::uint32_t>& base_triangles);

}  // namespace clues::reference
