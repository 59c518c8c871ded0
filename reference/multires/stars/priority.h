// The order in which vertices are looked at (D31): small, flat stars first. Area and curvature are doubles, because only the order they give
// matters, and it is a rule, not a claim: whatever it is, the hierarchy is one. Equal weights go by index.
#pragma once

#include <vector>

#include "exact/multires/star_rules.h"
#include "reference/multires/stars/star_complex.h"

namespace clues::reference {

// For every vertex that is still there, the rest 0. O(n).
std::vector<double> removal_weights_estimate(const StarComplex& complex, const std::vector<scene::Point>& points);

}  // namespace clues::reference
