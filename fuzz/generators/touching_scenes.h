// Small scenes of geometry that meets the view cell (D3, D10, D12): on its corners, edges and faces, in their lines and planes, inside. Cells of every
// dimension, small integers for coordinates, few triangles: what can coincide does.
#pragma once

#include <vector>

#include "fuzz/generators/degenerate_scenes.h"

namespace clues::fuzz {

// Each a pure function of seed and index: 1 to 10 triangles, small dyadic coordinates, and no triangle without area. The dial is the kind of the cell
// (cell_shapes.h).
const std::vector<DegenerateGenerator>& touching_generators();

}  // namespace clues::fuzz
