// The bound of the published sketch, for comparison only: it is NOT sound (A1.3). It takes a vertex and the foot of its perpendicular on the opposite edge
// for a short edge, but the nearest point of an edge that is seen obliquely is another one.
#pragma once

#include "fastpath/motion/bounds/bounds.h"

namespace clues::fastpath::motion {

double sketch_bound_unsound(const Row& a, const Row& b, const Row& c, const BoundThresholds& thresholds);

}  // namespace clues::fastpath::motion
