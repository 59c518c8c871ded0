#include "app/whole_level.h"

#include <utility>

#include "exact/sight/witness.h"
#include "scene/levels/bsp_scene.h"
#include "validate/cells/near_segment.h"
#include "validate/see_through/layers.h"

namespace clues::app {
namespace {

scene::RationalPoint rational_of(const exact::Point3& p) {
  return {mpq_class(p.x().exact()), mpq_class(p.y().exact()), mpq_class(p.z().exact())};
}

}  // namespace

WholeLevel::WholeLevel(const scene::BspFile& level)
    : whole_(scene::scene_of_level(level, scene::HullSides::all).scene), brushes_(level), far_plane_(level.far_plane) {}

bool WholeLevel::is_free_of_hulls(const exact::ConvexCell& cell, const validate::Witness& witness) const {
  validate::AskedAlone alone = validate::asked_alone(whole_, witness.triangle);
  const validate::NearSegment near =
      validate::near_segment(std::move(alone.mesh), alone.triangle, witness.v, witness.p);
  return exact::check_witness(near.mesh, cell, near.triangle, witness.front, witness.v, witness.p).valid;
}

std::size_t take_back(validate::Judgement& judgement,
                      const std::function<bool(const validate::Witness&)>& proves_nothing) {
  const std::size_t taken = std::erase_if(judgement.witnesses, [&](const validate::Witness& witness) {
    if (!proves_nothing(witness)) return false;
    auto& verdict = judgement.triangles[witness.triangle];
    if (verdict == validate::TriangleVerdict::missing_visible) {
      verdict = validate::TriangleVerdict::missing_undecided;
      --judgement.missing_visible;
      ++judgement.missing_undecided;
    } else if (verdict == validate::TriangleVerdict::exact) {
      verdict = validate::TriangleVerdict::first_order;
      --judgement.exact;
      ++judgement.first_order;
    }
    return true;
  });
  judgement.verdict = validate::verdict_of(judgement);
  return taken;
}

void WholeLevel::take_back(validate::Judgement& judgement) const {
  app::take_back(judgement, [&](const validate::Witness& witness) { return !is_free_of_brushes(witness); });
}

bool WholeLevel::is_free_of_brushes(const validate::Witness& witness) const {
  std::array<scene::Point, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = whole_.mesh.points[whole_.mesh.triangles[witness.triangle][i]];
  return !brushes_.block(rational_of(witness.v), rational_of(witness.p), corners);
}

}  // namespace clues::app
