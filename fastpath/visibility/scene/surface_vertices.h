// Which points of a local scene are vertices of its surface, and which a triangulation of the same surface could do without.
//
// What light meets depends on the surface as a set of points (D9), not on how it is cut into triangles. Flat faces can be cut into
// triangles anew without any vertex in their inside, or inside of the straight lines in which they meet. Points of these two kinds come from
// T-junctions and from faces that were given in parts; no SE-MV wedge of theirs (D12) bounds anything that is not bounded without
// it, unless another wedge meets the surface there: then they are compound silhouette vertices, as any point of an edge may be.
#pragma once

#include <vector>

#include "fastpath/visibility/scene/local_scene.h"

namespace clues::fastpath {

// By point of the scene. False where, next to the point, the surface is one flat disc, or half discs around one straight line on which the
// point lies. O(pieces). Needs RoundedUp in scope.
std::vector<bool> surface_vertices(const LocalScene& scene);

}  // namespace clues::fastpath
