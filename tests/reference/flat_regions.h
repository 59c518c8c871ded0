// Flat hidden regions with corners in whole numbers, inside one triangle, and what is asked of their simpler forms.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "reference/visibility/hidden/boundary_simplification.h"

namespace clues::test {

exact::Kernel::Triangle_2 outline();  // of the triangle: 200 long and high
reference::Ring2 ring(const std::vector<std::pair<int, int>>& corners);

reference::FlatSet set_of(const reference::Face2& face);
bool inside(const reference::Face2& inner, const reference::Face2& outer);
std::vector<exact::Point2> sorted(reference::Ring2 points);

reference::Face2 chamfered_square();  // 20 long and high; one corner is cut off
// Star-shaped polygons with corners on a circle of rays: convex and reflex corners in any order.
reference::Face2 star(std::uint64_t seed);

}  // namespace clues::test
