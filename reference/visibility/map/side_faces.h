// D15: one side of a piece of the complex as regions and segments of a map.
#pragma once

#include <vector>

#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

struct SideFaces {
  std::vector<Region> regions;      // ordered by their samples
  std::vector<DmSegment> segments;  // borders inside the triangle

  // The order in which a map has them.
  void sort();
  // At the end of the map; the regions are counted there.
  void move_to(VisibilityMap& map);
};

}  // namespace clues::reference
