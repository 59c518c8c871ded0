// D15: one side of a piece of the complex as regions and segments of a map, and as the set of what is visible on it.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

struct SideFaces {
  std::vector<Region> regions;      // ordered by their samples
  std::vector<DmSegment> segments;  // borders inside the triangle

  // The order in which a map has them.
  void sort();
  // At the end of the map; the regions are counted there.
  void move_to(VisibilityMap& map);
};

SideFaces side_faces(const FlatSet& visible, const TriangleFrame& frame, std::uint32_t piece, bool front);

// A region of the piece, laid flat.
Face2 flat_face(const Region& region, const TriangleFrame& frame);

// All of the triangle.
FlatSet whole_of(const TriangleFrame& frame);

}  // namespace clues::reference
