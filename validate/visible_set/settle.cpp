#include "validate/visible_set/settle.h"

#include <algorithm>

#include "validate/visible_set/visible_set.h"

namespace clues::validate {

void settle(Judgement& judgement, const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
            reference::Mode mode) {
  const auto open = undecided(judgement);
  if (open.empty()) return;
  VisibleSetOptions options;
  options.mode = mode;
  options.only = open;
  options.trust_map = false;  // what is open lies in Omega: the map has said all it knows
  const VisibleSet exact = exact_visible_set(mesh, cell, options);
  for (const std::uint32_t t : open) {
    const TriangleSight& found = exact.triangles[t];
    TriangleVerdict& verdict = judgement.triangles[t];
    const bool listed = verdict == TriangleVerdict::first_order;
    if (found.sight == Sight::visible) {
      if (found.witness) judgement.witnesses.push_back(*found.witness);
      verdict = listed ? TriangleVerdict::exact : TriangleVerdict::missing_visible;
      --(listed ? judgement.first_order : judgement.missing_undecided);
      ++(listed ? judgement.exact : judgement.missing_visible);
    } else if (found.sight == Sight::hidden) {
      judgement.proved_hidden.push_back(t);
      if (!listed) {
        verdict = TriangleVerdict::hidden;
        --judgement.missing_undecided;
      }
    }
  }
  std::sort(judgement.witnesses.begin(), judgement.witnesses.end(),
            [](const Witness& a, const Witness& b) { return a.triangle < b.triangle; });
  judgement.verdict = verdict_of(judgement);
}

}  // namespace clues::validate
