#include "reference/visibility/map/visibility_map.h"

#include "reference/visibility/map/sides.h"

namespace clues::reference {

void find_visible(const exact::SceneQuery& scene, VisibilityMap& map) {
  std::vector<bool> visible(map.complex.input_triangles, false);
  for (const Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (counts(map.mode, o, r.front)) visible[o.triangle] = true;
    }
  }
  for (std::uint32_t t = 0; t < map.complex.pieces.size(); ++t) {
    if (!scene.meets_cell(t)) continue;
    for (const exact::Origin& o : map.complex.pieces[t].origins) visible[o.triangle] = true;
  }
  map.visible.clear();
  for (std::uint32_t t = 0; t < visible.size(); ++t) {
    if (visible[t]) map.visible.push_back(t);
  }
}

}  // namespace clues::reference
