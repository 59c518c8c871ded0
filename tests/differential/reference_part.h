// The exact reference as the map of a part that the closure asks for (fastpath/visibility/closure/closure.h): so the closure is tested without the engine of
// the fast path.
#pragma once

#include <memory>

#include "exact/cell/convex_cell.h"
#include "exact/dials.h"
#include "fastpath/visibility/closure/closure.h"

namespace clues::tests {

// What a planted bug does to the answers. dark_below: so is what is right beside a triangle, on the side from which it is clockwise. unlit: no triangle is lit, and no wedge touches the triangles of
// the part.
enum class PartBug { none, dark_everywhere, wedges_touch_nothing, dark_below, unlit };

fastpath::PartialMapMaker reference_parts(const exact::ConvexCell& cell, PartBug bug = PartBug::none);

// Without rays, which find nearly all at once, there are several maps.
inline const exact::Dials kSeveralMaps = [] {
  exact::Dials dials;
  dials.sight_rays = 0;
  dials.batch = 10;
  return dials;
}();

}  // namespace clues::tests
