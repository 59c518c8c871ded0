// Which edges of a surface stay edge paths (D31): found by an angle, decided exactly.
#pragma once

#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::reference {

// Edges of two triangles whose normals are further apart than an angle of this cosine (-1 to 1, taken exactly); a triangle without area has no normal
// and makes no feature. Ascending. Throws Error bad_argument for another cosine. O(n log n).
std::vector<scene::Edge> sharp_edges(const scene::TriangleMesh& mesh, double cosine);

}  // namespace clues::reference
