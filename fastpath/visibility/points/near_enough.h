// The one search for a point that stands for a limit ("just beside", D13a, D14): nearer and nearer, until the place is good. It is good where exact signs say that nothing
// divides it from the limit; so how near it is found is a matter of effort, never of the answer.
#pragma once

#include <optional>

#include "fastpath/visibility/points/points.h"

namespace clues::fastpath {

// The first good one of place(level), place(level + 1), ... place(levels - 1), and which it was.
template <class Place, class Good>
std::optional<ExactPoint> near_enough(int& level, int levels, const Place& place, const Good& good) {
  for (; level < levels; ++level) {
    const ExactPoint x = place(level);
    if (good(x)) return x;
  }
  return std::nullopt;
}

template <class Place, class Good>
std::optional<ExactPoint> near_enough(int levels, const Place& place, const Good& good) {
  int level = 0;
  return near_enough(level, levels, place, good);
}

// From x on the way to another, as point_near() places it.
inline constexpr int kPointNearLevels = 7;
template <class Good>
std::optional<ExactPoint> near_enough(int& level, const ExactPoint& x, const ExactPoint& to, const Good& good) {
  return near_enough(
      level, kPointNearLevels, [&](int at) { return point_near(x, to, at); }, good);
}

}  // namespace clues::fastpath
