#include "scene/mesh/halved.h"

#include <algorithm>
#include <tuple>

namespace clues::scene {

Bounds bounds_around(std::span<const std::uint32_t> some, const std::vector<Bounds>& boxes) {
  Bounds around = boxes[some[0]];
  for (const std::uint32_t i : some) around = hull_of(around, boxes[i]);
  return around;
}

std::size_t halve(std::span<std::uint32_t> some, const std::vector<Bounds>& boxes) {
  const Bounds around = bounds_around(some, boxes);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    // Halves, because a difference of large numbers may not be one.
    if (around.high[i] / 2 - around.low[i] / 2 > around.high[axis] / 2 - around.low[axis] / 2) axis = i;
  }
  const auto key = [&](std::uint32_t i) { return std::tuple(boxes[i].low[axis] / 2 + boxes[i].high[axis] / 2, i); };
  const std::size_t half = some.size() / 2;
  std::nth_element(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(half), some.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return half;
}

}  // namespace clues::scene
