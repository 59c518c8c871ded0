// A point within the hull of some.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues {

// `weight()` is called for each of them, in order.
template <class Weight>
scene::Point point_within(const std::vector<scene::Point>& corners, Weight&& weight) {
  scene::Point out{};
  double sum = 0;
  for (const scene::Point& p : corners) {
    const double w = weight();
    sum += w;
    for (std::size_t i = 0; i < 3; ++i) out[i] += w * p[i];
  }
  for (double& x : out) x /= sum;
  return out;
}

}  // namespace clues
