// D17: when the search has ended, sources that a wedge which is not there may separate from the place that stands for them, or whose walk runs through what was left out. They are left out themselves.
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/visibility/search/sources.h"
#include "reference/visibility/wedges/anticone.h"

namespace clues::reference {

// Until there is none that what was added last concerns. Source::keeps_out becomes false where it does not. O(sources * what is left out in the end).
void leave_out_doubtful_sources(std::vector<Source>& sources, const std::vector<VertexSource>& vertex_sources,
                                const std::vector<ContourEdge>& contours, const exact::ConvexCell& cell,
                                LeftOut& left_out);

}  // namespace clues::reference
