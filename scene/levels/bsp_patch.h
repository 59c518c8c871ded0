// A Bezier patch of a level as triangles. They stand for a curved surface and lie beside it, so they never block (D22).
#pragma once

#include <array>
#include <vector>

#include "scene/levels/bsp_file.h"

namespace clues::scene {

// Each 3 x 3 control points that share a rim with the next ones become patch_steps x patch_steps quadrilaterals of two triangles, row by row.
std::vector<std::array<Point, 3>> triangles_of_patch(const BspFile& level, const BspFile::Face& patch);

}  // namespace clues::scene
