// Where solids come from.
#pragma once

#include <memory>
#include <vector>

#include "fastpath/solids/solids.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fastpath::solids {

// Of the triangles that block those that hang together, by corners with equal coordinates, and are the whole surface of a convex solid: a box, a turned one, a column. O(n log n).
std::vector<Solid> find_solids(const scene::FlaggedMesh& scene);

// Of faces (solid.h), each a list of one solid's; others are passed over.
std::vector<Solid> solids_of(const std::vector<std::vector<std::vector<Point>>>& faces);

// All that can be asked about: the triangles that count, and the cells.
Bounds bounds_of_questions(const scene::FlaggedMesh& scene, const std::vector<std::vector<Point>>& cells);

}  // namespace clues::fastpath::solids
