// The order in which vertices are looked at (D31): small, flat stars first. Area and curvature are doubles, because only the order they give
// matters, and it is a rule, not a claim: whatever it is, the hierarchy is one. Equal weights go by index.
#pragma once

#include <vector>

#include "reference/multires/stars/star_complex.h"

namespace clues::reference {

// The input moved and scaled by powers of two, so that squares and cubes of lengths neither overflow nor vanish. Doubles.
std::vector<scene::Point> points_for_estimates(const scene::TriangleMesh& mesh);

// a(i)/max a + kappa(i)/max kappa for every vertex that is still there, the rest 0; kappa is the sum of the absolute principal curvatures of a
// quadric over the plane of the star. O(n).
std::vector<double> removal_weights_estimate(const StarComplex& complex, const std::vector<scene::Point>& points);

}  // namespace clues::reference
