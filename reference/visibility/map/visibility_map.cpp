#include "reference/visibility/map/visibility_map.h"

#include "reference/visibility/map/sides.h"

namespace clues::reference {

std::vector<bool> that_meet_cell(const exact::SceneQuery& scene, const exact::Complex& complex) {
  std::vector<bool> meet(complex.input_triangles, false);
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (!scene.meets_cell(t)) continue;
    for (const exact::Origin& o : complex.pieces[t].origins) meet[o.triangle] = true;
  }
  return meet;
}

void find_visible(const exact::SceneQuery& scene, VisibilityMap& map) {
  std::vector<bool> visible = that_meet_cell(scene, map.complex);
  for (const Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (counts(map.mode, o, r.front)) visible[o.triangle] = true;
    }
  }
  map.visible.clear();
  for (std::uint32_t t = 0; t < visible.size(); ++t) {
    if (visible[t]) map.visible.push_back(t);
  }
}

}  // namespace clues::reference
