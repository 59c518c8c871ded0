// New places on the grids (D33), in whole numbers: weights in a triangle, where an edge crosses a diagonal, and what lies there on the input.
#pragma once

#include <optional>

#include "fastpath/multires/wide.h"

namespace clues::fastpath::multires {

// How much of a point between x and y each of the two is; both positive, below 2^112.
struct Parts {
  Wide of_x, of_y;
};

// The weights of a point of the closed triangle: each the ratio of areas rounded down to 2^-60, what is left over added to the largest (of equal ones,
// that of the lowest vertex). None: a positive weight would become 0.
std::optional<scene::CarrierPoint> weights_in(const scene::Triangle& triangle,
                                              const std::array<exact::DiskPoint, 3>& corners,
                                              const exact::FlatPoint& point);

// The weight of b at the point of the diagonal that lies between x and y, rounded down. None: it does not lie strictly between the ends.
std::optional<std::int64_t> place_on_diagonal(const exact::DiskPoint& a, const exact::DiskPoint& b,
                                              const exact::FlatPoint& x, const exact::FlatPoint& y, const Parts& parts);

// The mean of two points of one triangle: weights rounded down but not to 0, what is left over added to the largest (of equal ones, that of the
// lowest vertex). None: they lie in no common triangle.
std::optional<scene::CarrierPoint> mean_of(const scene::CarrierPoint& x, const scene::CarrierPoint& y,
                                           const Parts& parts);

}  // namespace clues::fastpath::multires
