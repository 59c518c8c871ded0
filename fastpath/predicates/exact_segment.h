// Stage 3 of the segment queries (D3, D5): the same questions in whole numbers and rationals (GMP). Slow, always right.
// The numbers stay in the .cpp, so that the fast translation units see neither GMP nor CGAL.
#pragma once

#include "fastpath/predicates/cell.h"
#include "fastpath/predicates/filter.h"

namespace clues::fastpath {

// True when the corners are collinear: no surface.
bool degenerate_exact(const Corners& t);

// Whether the open segment meets the closed triangle, which has area.
bool meets_exact(const Segment& s, const Corners& t);

// Whether the plane of the triangle, which has area, misses int V: then whatever meets the triangle meets it outside. False may also mean that points are too long for a quick answer.
bool misses_inside_of(const Corners& t, const Cell& cell);

// Whether it meets a point of the triangle outside int V.
bool blocks_exact(const Segment& s, const Corners& t, const Cell& cell);

// Which of two triangles that block s (outside int V, when there is a cell) does so first: -1 for x, 1 for y, 0 when at the same
// parameter. A triangle along the segment counts from where its part begins, even if that point itself does not belong to it.
int compare_first_exact(const Segment& s, const Corners& x, const Corners& y, const Cell* cell);

}  // namespace clues::fastpath
