// Parts of contour edges that may wait for each other in a circle, like the blades of an iris, each asked where the next one hides it (definition.md, section 6, and docs/fast-path.md: "Parts that wait
// for each other"). They are cut at each other's planes; then in no circle each waits for the next.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fastpath/visibility/search/sources.h"

namespace clues::fastpath {

// The edges of parts that have to be cut, and points inside the parts at which; the pools of the workers keep these. Of whole circles, whether their parts are lit or not. The same for any number of
// threads. Needs RoundedUp in scope. O(parts * parts in front of them) tests of boxes; memory goes with the edges in front of each part.
std::vector<std::pair<std::uint32_t, const ExactPoint*>> cuts_of_circles(const LocalScene& scene,
                                                                         const std::vector<ContourEdge>& contours,
                                                                         const std::vector<Sources::OfEdge>& parts,
                                                                         Workers& workers);

}  // namespace clues::fastpath
