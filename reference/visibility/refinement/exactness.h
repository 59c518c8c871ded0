// FIG. 27: where a first-order wedge is exact. From a point y of the edge whose segment to the touching cell vertex s meets no surface,
// sight lines from int V beside s pass y on the H- side and run along the wedge: up to its first blocker it is the border of E itself. Where something is in the
// way the wedge may still be exact; it is certain only where nothing is.
#pragma once

#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/wedges/wedge.h"

namespace clues::reference {

// A part of the near segment of an SV-ME or SE-ME wedge; lo and hi as near0 and near1.
struct Portion {
  exact::Point3 lo, hi;
  bool exact = false;  // nothing between it and the wedge's centre
};

// The near segment between the wedge's rays, cut where the shadows of obstacles seen from the centre begin and end. Touching counts as obstruction; what blocks
// one ray only does not. For wedges of mesh edges. O(m log m) for m occluders near the supporting triangle.
std::vector<Portion> portions(const exact::SceneQuery& scene, const Wedge& wedge);

}  // namespace clues::reference
