// Files that findings and subjects share.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// An OBJ file of points only: a cell (D2). Every double survives.
std::string points_as_obj(const std::vector<scene::Point>& points);

}  // namespace clues::fuzz
