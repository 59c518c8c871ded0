// How much too much and how much too little a PVS lists, under the names of the field (Bittner et al. 2005): with E the exact visible set and S the PVS, the
// overestimate Qo = |S without E| / |E| and the underestimate Qu = |E without S| / |E|. Where the judge could not decide a triangle both are given from below and from above.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "exact/cell/standard_range.h"
#include "exact/kernel.h"
#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::validate {

// Quantities of the triangles by what the judge knows: a sum of ones, or of areas.
struct Weights {
  double visible_listed = 0, visible_missing = 0;      // in E for certain
  double undecided_listed = 0, undecided_missing = 0;  // in Omega, no witness
  double hidden_listed = 0;                            // loose, or proved hidden
  exact::StandardRange range = {};                     // of areas, so that their ratios are numbers for any scene
};

struct Bounds {
  double at_least = 0, at_most = 0;
};

// Of the whole PVS; none where nothing is certainly visible.
std::optional<Bounds> over_estimate(const Weights& weights);
std::optional<Bounds> under_estimate(const Weights& weights);

Weights count_weights(const Judgement& judgement);                                  // exact
Weights area_weights(const Judgement& judgement, const scene::TriangleMesh& mesh);  // rounded as area.h says

// Per input triangle the part of its front and of its back side that is in Omega, exactly. In solid mode the back side is 0.
std::vector<std::array<exact::FT, 2>> first_order_fractions(const scene::TriangleMesh& mesh,
                                                            const reference::VisibilityMap& map);

}  // namespace clues::validate
