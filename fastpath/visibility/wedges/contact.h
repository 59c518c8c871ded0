// Whether a triangle keeps away from the inside of another: the question by which the closure (closure.h) tells that nothing stands between the points of
// a triangle. One-sided: `true` may be wrong, `false` is proved by exact signs.
#pragma once

#include "fastpath/predicates/filter.h"

namespace clues::fastpath {

// False only if the closed triangle `other` has no point in the relative interior of t. Both have area. Answers false for triangles that
// are apart, that share a corner or an edge and nothing more, and when t stands on `other`.
bool may_meet_inside_conservative(const Corners& t, const Corners& other);

// Exactly: whether all corners of `other` lie in the plane of t; and on which side of it p is (1: counterclockwise from there, 0: in it).
bool in_plane_of(const Corners& t, const Corners& other);
int side_of_plane(const Corners& t, const Point& p);

}  // namespace clues::fastpath
