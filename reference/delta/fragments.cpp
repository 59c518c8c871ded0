#include "reference/delta/fragments.h"

#include <algorithm>

namespace clues::reference {

Rings3 rings_from_its_side(const Region& region) {
  Rings3 rings = region.rings;
  if (!region.front) {
    for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
  }
  return rings;
}

FragmentMesh visible_fragments(const VisibilityMap& map) {
  FragmentMesh out;
  std::vector<Rings3> rings;
  for (std::uint64_t i = 0; i < map.regions.size(); ++i) {
    if (!map.regions[i].visible) continue;
    out.regions.push_back(i);
    rings.push_back(rings_from_its_side(map.regions[i]));
  }
  out.mesh = sew(rings);
  return out;
}

}  // namespace clues::reference
