#include "app/whole_level.h"

#include "exact/sight/witness.h"
#include "scene/levels/bsp_scene.h"

namespace clues::app {

WholeLevel::WholeLevel(const scene::BspFile& level)
    : whole_(scene::scene_of_level(level, scene::HullSides::all).scene) {}

bool WholeLevel::confirms(const std::vector<scene::Point>& cell, const validate::Witness& witness) const {
  std::vector<std::uint32_t> ids;
  std::uint32_t place = 0;
  for (std::uint32_t t = 0; t < whole_.mesh.triangles.size(); ++t) {
    if (t == witness.triangle) place = static_cast<std::uint32_t>(ids.size());
    if (t == witness.triangle || whole_.blocking(t)) ids.push_back(t);
  }
  return exact::check_witness(scene::part_of(whole_.mesh, ids), exact::ConvexCell::from_doubles(cell), place,
                              witness.front, witness.v, witness.p)
      .valid;
}

}  // namespace clues::app
