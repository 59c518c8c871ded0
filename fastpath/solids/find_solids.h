// Where solids come from.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/solids/solids.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fastpath::solids {

// Of the triangles that block those that hang together and are the whole surface of a convex solid: a box, a turned one, a column. They do by common vertices; what is no solid then, by edges that two of them
// have in coordinates, as boxes that touch at a corner or along an edge; and else by corners. O(n log n).
std::vector<Solid> find_solids(const scene::FlaggedMesh& scene);

std::vector<Solid> solids_of(const std::vector<scene::Polytope>& polytopes);

// All that can be asked about: the triangles that count, and the cells.
Bounds bounds_of_questions(const scene::FlaggedMesh& scene, const std::vector<std::vector<Point>>& cells);

// What the solids in a scene do not hide from one cell (shafts.h).
std::vector<std::uint32_t> not_hidden(const scene::FlaggedMesh& scene, const std::vector<Point>& cell);

}  // namespace clues::fastpath::solids
