// D5, one sight line against one triangle, exactly: occluders are closed, the segment is open at p.
#pragma once

#include <array>

#include "exact/kernel.h"

namespace clues::exact {

// Whether the closed triangle meets the segment from `end` to p without p; `end` itself counts when `closed`. The triangle has
// area; p != end.
bool blocks(const std::array<Point3, 3>& triangle, const Point3& end, bool closed, const Point3& p);

}  // namespace clues::exact
