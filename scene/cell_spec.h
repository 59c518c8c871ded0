// D2: a view cell is given by points; the cell is their convex hull. This header only reads what the user
// wrote; exact/cell/convex_cell.h builds the polytope.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::scene {

struct CellSpec {
  std::string name;           // what the user wrote, or the grid index "i,j,k" for a grid cell
  std::vector<Point> points;  // at least one, finite; for a box its 8 (or, if flat, 4, 2, 1) distinct corners
};

// "box:x0,y0,z0,x1,y1,z1" (x0 <= x1 ...; equal bounds make a flat cell), or the path of an OBJ, OFF, PLY or
// STL file whose vertices' hull is the cell (a file with vertices and no faces is fine here).
// Throws Error bad_cell (inverted box, wrong count, no point), non_finite, or a file error.
CellSpec parse_cell(const std::string& text);

// "grid:NXxNYxNZ:box:x0,y0,z0,x1,y1,z1": the box cut into NX*NY*NZ equal boxes, x fastest. A bound shared by
// two cells is the same double in both. Anything else is one parse_cell.
std::vector<CellSpec> parse_cells(const std::string& text);

}  // namespace clues::scene
