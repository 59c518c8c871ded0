// D24: what a cell sees of the sides of the input triangles, as exact planar sets. Maps are about pieces (D16), and the
// pieces of two cells differ where one of them meets the scene; the triangles of the file are the same for both.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/planar/flat_set.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

// Of an input triangle, as side_index() of a piece.
struct InputSide {
  std::uint32_t triangle = 0;
  bool front = true;
};

// The sides that count in the mode (D4) of the triangles with an area, by triangle, fronts first.
std::vector<InputSide> input_sides(const scene::TriangleMesh& mesh, Mode mode);

// The triangle laid flat, the same way for every map: its front turns counter-clockwise.
TriangleFrame frame_of(const scene::TriangleMesh& mesh, std::uint32_t triangle);

// VM of D24 for each of the sides: the closure of what the map calls visible there. The map is in the coordinates of
// the mesh. O(n log n).
std::vector<FlatSet> visible_on(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                const VisibilityMap& map);

}  // namespace clues::reference
