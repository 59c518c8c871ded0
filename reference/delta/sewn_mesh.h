// Planar regions as one triangle mesh without cracks (D15, FIG. 33: fragments that can be sent). Corners are shared by
// all regions that have them, and no corner lies inside a side of a region: where it would, the side is cut there. So
// the same points stay the same whatever becomes of their coordinates, and rounding opens no gap.
//
// Nothing is added inside of a region. Its triangles are a triangulation of its corners; an edge between two of them
// is used by both, once in each direction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact/kernel.h"

namespace clues::reference {

// Rings in one plane: outer boundaries counter-clockwise as seen from the region's front, holes clockwise. They may
// touch; an edge that is walked both ways bounds nothing.
using Rings3 = std::vector<std::vector<exact::Point3>>;

struct SewnMesh {
  struct Triangle {
    std::array<std::uint64_t, 3> corners{};  // the smallest first, counter-clockwise from the front of the region
    std::uint64_t region = 0;
  };
  std::vector<exact::Point3> points;  // distinct, in lexicographic order
  std::vector<Triangle> triangles;    // by region, then by corners
};

// Each region has an area. O(n log n) for n corners, and as many tests as there are corners near sides.
SewnMesh sew(const std::vector<Rings3>& regions);

}  // namespace clues::reference
