// View cells of every dimension (D2) with small coordinates and with their faces, so that geometry can be put on them on purpose.
#pragma once

#include <array>
#include <vector>

#include "fuzz/generators/random.h"
#include "scene/mesh/mesh.h"

namespace clues::fuzz {

// Coordinates are integers of at most 8.
struct CellShape {
  int dimension = 0;
  std::vector<scene::Point> vertices;             // extreme points only
  std::vector<std::array<std::size_t, 2>> edges;  // of a segment: itself
  std::vector<std::vector<std::size_t>> faces;    // corners in cyclic order; of a polygon: itself
};

inline constexpr int cell_kinds = 8;  // point, two of segments, three of polygons, box, other solids
// 0: point; 1, 2: segment, parallel to an axis or anyhow; 3: rectangle parallel to two axes; 4: triangle or quadrilateral, 5: up to six corners, in any plane;
// 6: box; 7: prism or pyramid over a polygon, a tetrahedron among them.
CellShape cell_shape(int kind, Random& random);

}  // namespace clues::fuzz
