// What is next to a part of a mesh, for a guess at what else has to be mapped: nothing is proved by it. Two triangles are neighbours if they have two corners in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::fastpath {

// Triangles with two corners that the part has, too, ascending. O(mesh).
std::vector<std::uint32_t> neighbours_of(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> part);

// Of these the ones that are beside a triangle of the part as they are seen from `eye`, and not in front of it or behind it: in the picture they go on where that one ends. So they are seen where it is
// seen up to the edge, unless something else is in front.
std::vector<std::uint32_t> neighbours_in_sight(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> part,
                                               const scene::Point& eye);

}  // namespace clues::fastpath
