// A part of a mesh as a mesh of its own.
#pragma once

#include <cstdint>
#include <span>

#include "scene/mesh/mesh.h"

namespace clues::fastpath {

// These triangles, in this order and each a face, with the points that they use, which stay in order. O(n log n) for n triangles, whatever the mesh has.
scene::TriangleMesh mesh_of(const scene::TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

}  // namespace clues::fastpath
