// Polygons and boxes in doubles, for what is not decided by them alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
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

inline bool touch(const Rectangle& a, const Rectangle& b) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (b.low[i] > a.high[i] || a.low[i] > b.high[i]) return false;
  }
  return true;
}

template <std::size_t N>
std::array<double, N> middle_of(const std::vector<std::array<double, N>>& points) {
  std::array<double, N> middle{};
  for (const auto& p : points) {
    for (std::size_t i = 0; i < N; ++i) middle[i] += p[i] / static_cast<double>(points.size());
  }
  return middle;
}

// A convex polygon, or the corners of a box, cut out of a whole. Its corners are rounded where it was cut.
struct Piece {
  Piece() = default;
  explicit Piece(std::span<const scene::Point> all)
      : corners(all.begin(), all.end()), whole(all), box(scene::bounds_of(corners)) {}

  std::vector<scene::Point> corners;
  std::span<const scene::Point> whole;  // all of it is in the hull of these, exactly,
  scene::Bounds box;                    // and in this box
};

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

// In the middle of the axis: both have all of the polygon in their union, but for roundings.
inline std::array<Piece, 2> halves_of(const Piece& piece, const scene::Bounds& box, std::size_t axis) {
  const double middle = (box.low[axis] + box.high[axis]) / 2;
  std::array<Piece, 2> halves{piece, piece};
  halves[0].corners = clipped(piece.corners, axis, middle, false);
  halves[1].corners = clipped(piece.corners, axis, middle, true);
  halves[0].box.high[axis] = std::min(piece.box.high[axis], middle);
  halves[1].box.low[axis] = std::max(piece.box.low[axis], middle);
  return halves;
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
