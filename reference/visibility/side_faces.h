// One side of a piece of the complex as regions and segments of a map, from the set of what is visible on it.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/visibility/first_order.h"
#include "reference/visibility/flat_set.h"

namespace clues::reference {

struct SideFaces {
  std::vector<Region> regions;      // ordered by their samples
  std::vector<DmSegment> segments;  // the borders of the set inside the triangle
};

SideFaces side_faces(const FlatSet& visible, const TriangleFrame& frame, std::uint32_t piece, bool front);

// All of the triangle.
FlatSet whole_of(const TriangleFrame& frame);

}  // namespace clues::reference
