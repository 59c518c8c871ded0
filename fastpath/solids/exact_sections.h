// The exact half of section.h: polygons that solids cut out of a plane, and the rim of their union.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fastpath/solids/section.h"

namespace clues::fastpath::solids {

// A point of the plane, and its coordinates as doubles: nearest but for one bit, or exact where `brief` says so.
struct ExactSpot {
  double x = 0, y = 0;
  bool brief = false;  // multiples of 2^-6 below 2^17: determinants of such are exact in doubles
  mpq_class exact_x, exact_y;  // unless it is brief
};

// Strictly convex, counter-clockwise; none where the plane does not cross the solid's interior. `dropped` is the axis that is left out of the coordinates.
std::optional<std::vector<ExactSpot>> section_of(const Solid& solid, const SectionPlane& plane, std::size_t dropped);

// What of the polygons' edges borders their union, as a closed set without whiskers: where the outer side of an edge is in no polygon. Rounded.
std::vector<std::array<Section::Spot, 2>> rim_of_union(const std::vector<std::vector<ExactSpot>>& polygons);

}  // namespace clues::fastpath::solids
