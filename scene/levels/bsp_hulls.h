// The walls behind what is drawn. A structural brush is solid, and so is every triangle with corners in it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"

namespace clues::scene {

// How far from a side of its brush a drawn triangle that enters the brush may lie and still be taken for a drawing of that
// side. Compilers move drawn vertices to a grid and stitch faces; a quarter of a unit is the most that was met.
inline constexpr double side_thickness = 0.5;

// How deep behind the plane of the side the triangle reaches, in units of its normal, if it lies within side_thickness of it as a whole; else none: it is no drawing of the side.
std::optional<mpq_class> depth_of_drawing(const HalfSpace& side, const std::array<Point, 3>& drawn);

// The faces of a convex solid, each a polygon that is nearly flat; the corners are doubles.
using Hull = std::vector<std::vector<Point>>;

// The brush within the bounds. Where a drawn triangle enters it a little, its sides are held behind that: no point of a triangle
// that lies within side_thickness of a side, as a whole, is in the interior of what is returned. None where nothing is left.
std::optional<Polytope> solid_of_brush(const BspFile& level, const BspFile::Brush& brush, const Polytope& bounds,
                                       const std::vector<std::array<Point, 3>>& drawn);

// With all corners in the solid, so that every triangle between them lies in it. Empty where it is too thin for doubles.
Hull hull_of_solid(const Polytope& solid);

}  // namespace clues::scene
