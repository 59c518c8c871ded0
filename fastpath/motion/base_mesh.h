// The icosahedral base mesh (A1.4): 162 directions and 320 triangles, which keep every depth mesh around its viewpoint, whatever it sees.
#pragma once

#include <cstdint>

#include "scene/motion/depth_mesh.h"

namespace clues::fastpath::motion {

inline constexpr std::uint32_t kBaseVertices = 162;

// An icosahedron with each side cut into four, as directions of any length: 10 * 16 + 2 of them. Front facing from everywhere.
scene::DepthMesh icosahedral_base();

}  // namespace clues::fastpath::motion
