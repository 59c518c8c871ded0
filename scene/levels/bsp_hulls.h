// The walls behind what is drawn. A structural brush is solid, and so is every triangle with corners in it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"

namespace clues::scene {

// How far from a side of its brush a drawn triangle that enters the brush may lie and still be taken for a drawing of that
// side. Compilers move drawn vertices to a grid and stitch faces; a quarter of a unit is the most that was met.
inline constexpr double side_thickness = 0.5;

// The faces of a convex solid, each a polygon that is nearly flat; the corners are doubles.
using Hull = std::vector<std::vector<Point>>;

// With all corners in the brush, so that every triangle between them lies in it. Where a drawn triangle enters the brush a
// little, the hull is held behind it: no point of a triangle that lies within side_thickness of a side, as a whole, is in
// the interior of what is returned. Empty where nothing is left.
Hull hull_of_brush(const BspFile& level, const BspFile::Brush& brush, const Polytope& bounds,
                   const std::vector<std::array<Point, 3>>& drawn);

}  // namespace clues::scene
