#include "app/whole_level.h"

#include "exact/sight/witness.h"
#include "scene/levels/bsp_scene.h"
#include "validate/see_through/layers.h"

namespace clues::app {

WholeLevel::WholeLevel(const scene::BspFile& level)
    : whole_(scene::scene_of_level(level, scene::HullSides::all).scene) {}

bool WholeLevel::confirms(const std::vector<scene::Point>& cell, const validate::Witness& witness) const {
  const validate::AskedAlone alone = validate::asked_alone(whole_, witness.triangle);
  return exact::check_witness(alone.mesh, exact::ConvexCell::from_doubles(cell), alone.triangle, witness.front,
                              witness.v, witness.p)
      .valid;
}

}  // namespace clues::app
