#include "fuzz/findings/witness_text.h"

#include "exact/sight/witness.h"
#include "scene/messages/error.h"
#include "validate/certificates/words.h"
#include "validate/see_through/layers.h"
#include "validate/windows/rational.h"

namespace clues::fuzz {

using exact::Point3;
using validate::Witness;

WitnessText to_text(const Witness& w) {
  const auto text = [](const Point3& p) {
    return std::array<std::string, 3>{exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                                      exact::to_string_exact(p.z())};
  };
  return {w.triangle, w.front, text(w.v), text(w.p)};
}

Witness to_witness(const WitnessText& w) {
  const auto point = [](const std::array<std::string, 3>& text) {
    validate::RVector q;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!validate::is_rational(text[i]))
        throw scene::Error(scene::ErrorCode::malformed, "a witness has a coordinate that is no fraction: " + text[i]);
      q[i] = validate::Rational(text[i]);
      q[i].canonicalize();
    }
    return validate::to_point(q);
  };
  return {w.triangle, w.front, point(w.v), point(w.p)};
}

exact::WitnessVerdict check_flagged_witness(const scene::FlaggedMesh& scene, const exact::ConvexCell& cell,
                                            const Witness& w) {
  const auto alone = validate::asked_alone(scene, w.triangle);
  return exact::check_witness(alone.mesh, cell, alone.triangle, w.front, w.v, w.p);
}

}  // namespace clues::fuzz
