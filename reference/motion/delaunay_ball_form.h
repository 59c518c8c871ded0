// T9, form 3: the tightest of the three, for samples of any kind.
#pragma once

#include <array>

#include "exact/motion/rational_vector.h"
#include "reference/motion/bounds.h"

namespace clues::reference {

using Quadrangle = std::array<const DepthSample*, 4>;

// What the form proves, to a millionth, for the best of the four as the base, with or without a common factor of the cofactors, to a 64th; at least `known`.
// The viewpoint stands on no point.
double ball_form(const Quadrangle& samples, const ExactViewpoint& v, double known);

}  // namespace clues::reference
