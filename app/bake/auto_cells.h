// Cells where somebody could walk: boxes of a grid that lie within a height above what is not too steep.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/bakes/bake_store.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::app {

struct AutoCells {
  std::vector<scene::BakePlace> cells;    // named "i,j,k"; x fastest
  std::uint64_t boxes = 0;                // of the grid around the scene and the height above it
  std::uint64_t walkable = 0, steep = 0;  // triangles that block
};

// Boxes with edges of length `size` and corners at its multiples that hold a point at most `height` above a triangle that blocks and is at most 45
// degrees steep. `up`: 'y' or 'z'. Throws Error bad_argument where there would be more than 10 million boxes, or none.
AutoCells auto_cells(const scene::FlaggedMesh& scene, double size, double height, char up);

}  // namespace clues::app
