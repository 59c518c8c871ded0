// Whether two maps of one scene are the same, region by region, in exact coordinates. Where a ring starts and the order of regions do not count.
#pragma once

#include <set>
#include <string>

#include "reference/visibility/first_order.h"

namespace clues::test {

// One line for each region: side, label, rings. Pieces are named by their corners, so that numberings do not matter.
std::multiset<std::string> region_lines(const reference::VisibilityMap& map);

// The same for DM segments and for valid wedge pieces.
std::multiset<std::string> segment_lines(const reference::VisibilityMap& map);
std::multiset<std::string> wedge_lines(const std::vector<reference::Wedge>& wedges);

}  // namespace clues::test
