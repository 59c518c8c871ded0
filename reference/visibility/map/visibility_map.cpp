#include "reference/visibility/map/visibility_map.h"

#include <algorithm>
#include <iterator>

#include "reference/visibility/map/sides.h"

namespace clues::reference {
namespace {

// The input triangles with a region that `holds` and counts, or with a point in V.
template <class Holds>
std::vector<std::uint32_t> triangles_with(const exact::SceneQuery& scene, const VisibilityMap& map,
                                          const Holds& holds) {
  std::vector<bool> found(map.complex.input_triangles, false);
  for (const Region& r : map.regions) {
    if (!holds(r)) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (counts(map.mode, o, r.front)) found[o.triangle] = true;
    }
  }
  for (std::uint32_t t = 0; t < map.complex.pieces.size(); ++t) {
    if (!scene.meets_cell(t)) continue;
    for (const exact::Origin& o : map.complex.pieces[t].origins) found[o.triangle] = true;
  }
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < found.size(); ++t) {
    if (found[t]) ids.push_back(t);
  }
  return ids;
}

}  // namespace

void find_visible(const exact::SceneQuery& scene, VisibilityMap& map) {
  map.visible = triangles_with(scene, map, [](const Region& r) { return r.visible; });
}

void find_in_doubt(const exact::SceneQuery& scene, VisibilityMap& map) {
  const auto known = triangles_with(scene, map, [](const Region& r) { return r.known; });
  map.in_doubt.clear();
  std::set_difference(map.visible.begin(), map.visible.end(), known.begin(), known.end(),
                      std::back_inserter(map.in_doubt));
}

}  // namespace clues::reference
