// Parts of contour edges that may wait for each other (definition.md, section 6). A part is asked at one place (D13a), and it is cut by the wedges of other parts, which are
// asked at one place. Where edges overlap in a circle, like the blades of an iris, each may be asked under the next blade, where it is dark, though its other end, at the window, is seen: then
// none of the wedges of the window is ever made. So parts that may wait for each other in a circle are cut at each other's planes; then no circle is left in which each waits
// for the next (T12, 2).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "exact/sight/scene_query.h"
#include "reference/visibility/search/sources.h"

namespace clues::reference {

// Points inside of parts at which these have to be cut: the edge, and the point. Of whole circles, whether their parts are lit or not. Each source waits for those that it would
// take a long proof to say it does not wait for: a cut too many divides equals. O(parts * parts in front of them).
std::vector<std::pair<std::uint32_t, exact::Point3>> cuts_of_circles(const exact::SceneQuery& scene,
                                                                     const std::vector<ContourEdge>& contours,
                                                                     const std::vector<Source>& sources);

}  // namespace clues::reference
