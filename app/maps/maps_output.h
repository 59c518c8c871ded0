// What `clues maps` draws: the base domain, and the input with a colour for each base triangle.
#pragma once

#include <string>

#include "reference/multires/remesh.h"

namespace clues::app {

// The pieces of the overlay where they lie on the input, each with the colour of its base triangle (ascii PLY). Positions are estimates.
std::string patches_to_ply(const scene::Hierarchy& hierarchy);

// The base domain as it is seen along the third axis, far triangles first, in the same colours (SVG).
std::string base_to_svg(const scene::Hierarchy& hierarchy);

// The base domain with vertices of the input; those that it does not use are left out.
std::string base_to_off(const scene::Hierarchy& hierarchy);

// The input, cut along the parameter lines of the remesh: its triangles light, and dark where they stand on their heads, in the colours of their base
// triangles (ascii PLY). Positions are estimates.
std::string checker_to_ply(const reference::Remesh& remesh, const scene::TriangleMesh& input);

}  // namespace clues::app
