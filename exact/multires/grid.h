// Signs of D31 to D33 in whole numbers of 128 bits. With weights over 2^60 and flattened stars over 2^24 nothing overflows: a flattened
// point has 86 bits, its orientation with two ring vertices 60 + 2 * 24 + 4 = 112, that of three points of one triangle by their
// weights 2 * 60 + 3 = 123, the circle of four ring vertices 4 * 24 + 12 = 108. So every sign is exact, and none needs a filter.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "scene/multires/hierarchy.h"

namespace clues::exact {

__extension__ typedef __int128 Wide;

inline int sign_of(Wide value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

// A vertex of a flattened star, in units of 2^-24.
using DiskPoint = std::array<std::int64_t, 2>;
// Any point of it, in units of 2^-84.
struct FlatPoint {
  Wide x = 0, y = 0;
};

// Twice the area of a, b, c, in units of 2^-48: positive when they turn counter-clockwise.
inline Wide orientation(const DiskPoint& a, const DiskPoint& b, const DiskPoint& c) {
  return Wide{b[0] - a[0]} * (c[1] - a[1]) - Wide{b[1] - a[1]} * (c[0] - a[0]);
}
// The same with a point of the finer grid, in units of 2^-108.
inline Wide orientation(const DiskPoint& a, const DiskPoint& b, const FlatPoint& q) {
  const Wide dx = q.x - Wide{a[0]} * scene::whole_weight, dy = q.y - Wide{a[1]} * scene::whole_weight;
  return (b[0] - a[0]) * dy - (b[1] - a[1]) * dx;
}
// 1: d lies inside of the circle through a, b, c, which turn counter-clockwise; 0: on it.
int in_circle(const DiskPoint& a, const DiskPoint& b, const DiskPoint& c, const DiskPoint& d);

// The sign of the area of three points of one triangle, whose corners are given in order. Weights of other vertices do not count.
int orientation_in(const scene::Triangle& triangle, const scene::CarrierPoint& a, const scene::CarrierPoint& b,
                   const scene::CarrierPoint& c);
// The area itself as a part of the triangle's, in units of 2^-120.
Wide area_in(const scene::Triangle& triangle, const scene::CarrierPoint& a, const scene::CarrierPoint& b,
             const scene::CarrierPoint& c);

// The point with these weights, by vertex, which are rounded down and lack `left` of the whole: that goes to the largest, the first of them by vertex. A weight of 0 names no corner.
scene::CarrierPoint rounded_point(std::array<std::pair<std::uint32_t, std::int64_t>, 3> weights, std::int64_t left);

}  // namespace clues::exact
