// Small scenes of geometry that meets the view cell (D3, D10, D12): on its corners, edges and faces, in their lines and planes, inside. Cells of every
// dimension, small integers for coordinates, few triangles: what can coincide does.
#pragma once

#include <vector>

#include "fuzz/generators/degenerate_scenes.h"

namespace clues::fuzz {

// Each a pure function of seed and index: 1 to 10 triangles, small dyadic coordinates, and no triangle without area. The dial is the kind of the cell
// (cell_shapes.h).
const std::vector<DegenerateGenerator>& touching_generators();

// One of degenerate_generators(): grooves that stand on the cell. Walls meet in a line which the closed cell touches; what they leave open is seen along the line by viewers next to it, however near to it, and
// where they leave nothing open all is hidden. Walks (D14) run into both. The dial: how deep inside the groove something is looked for, 1/2 to 2^-8. Cells: a polygon, with the line inside or on its rim; a segment on the line; a
// solid with the line on a face or on an edge; and next to the line.
GeneratedScene grooves_on_cells(std::uint64_t seed, std::uint64_t index);
// The same, with walls that end in two points of the line, where lids close the groove, or leave a gap or a notch.
GeneratedScene grooves_with_lids(std::uint64_t seed, std::uint64_t index);

// Another one: a floor in the plane of a cell that is flat, a segment or a point, walls on its seams, and small triangles right above and below it: one side
// is dark, the other is seen, and neither light nor an event surface is between the two (floor_scenes.cpp). The dial: 4 and more for 66 of these, so that the
// fast path does not map the scene as a whole.
GeneratedScene floors_under_cells(std::uint64_t seed, std::uint64_t index);

}  // namespace clues::fuzz
