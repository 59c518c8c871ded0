// Polygons and boxes in doubles, for what is not decided by them alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/mesh/bounds.h"

namespace clues::fastpath::solids {

using Spot = std::array<double, 2>;  // in a plane, with one coordinate left out

struct Rectangle {
  Spot low{}, high{};
  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

inline Rectangle hull_of(const Rectangle& a, const Rectangle& b) {
  Rectangle out;
  for (std::size_t i = 0; i < 2; ++i) {
    out.low[i] = std::min(a.low[i], b.low[i]);
    out.high[i] = std::max(a.high[i], b.high[i]);
  }
  return out;
}

// Along which the box is longest.
inline std::size_t longest_axis(const scene::Bounds& box) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
  }
  return axis;
}

// What of a convex polygon is at `bound` along the axis or beyond, above or below; where an edge crosses, rounded.
template <std::size_t N>
std::vector<std::array<double, N>> clipped(const std::vector<std::array<double, N>>& polygon, std::size_t axis,
                                           double bound, bool above) {
  std::vector<std::array<double, N>> left;
  const double sign = above ? 1 : -1;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double at_a = sign * (a[axis] - bound), at_b = sign * (b[axis] - bound);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const double share = at_a / (at_a - at_b);
      auto between = a;
      for (std::size_t i = 0; i < N; ++i) between[i] += share * (b[i] - a[i]);
      between[axis] = bound;
      left.push_back(between);
    }
  }
  return left;
}

// The corners of the hull of sorted points, counter-clockwise; turn(a, b, c) is positive where they turn left. One point of points that are all the same, two of points on a line.
template <typename P, typename Turn>
void hull_of_sorted(const std::vector<P>& points, const Turn& turn, std::vector<P>& hull) {
  hull.clear();
  const auto go_on = [&](const P& p, std::size_t least) {
    while (hull.size() >= least + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const P& p : points) go_on(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) go_on(points[i], lower);
  if (hull.size() > 1) hull.pop_back();
}

}  // namespace clues::fastpath::solids
