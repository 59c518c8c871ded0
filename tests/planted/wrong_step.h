// What a simplification does to a map that takes a step on the wrong side of a border (plant.py).
#pragma once

#include "reference/visibility/map/visibility_map.h"

namespace clues::test {

// The simplified map must hide more than this one, and some of that must be seen: else the test fails.
void expect_hides_what_is_seen(const reference::VisibilityMap& map);

}  // namespace clues::test
