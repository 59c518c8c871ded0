// Points between points of one triangle, on the grid of weights.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <utility>
#include <vector>

#include "exact/multires/grid.h"

namespace clues::reference {

mpz_class to_integer(exact::Wide value);

// The mean of points with these positive parts, its weights rounded down to 2^-60 but not to 0, what is left over added to the largest (of equal
// ones, that of the lowest number). None: the points lie in no common triangle.
std::optional<scene::CarrierPoint> combined(const std::vector<std::pair<const scene::CarrierPoint*, mpz_class>>& parts);

}  // namespace clues::reference
