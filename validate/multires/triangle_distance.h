// Whether a point of one mesh is as near to a triangle of another as a number says, exactly: D34, for E7.
#pragma once

#include <array>

#include "scene/multires/hierarchy.h"

namespace clues::validate {

// A point by weights over 2^60 of corners of a mesh.
struct WeightedPoint {
  const scene::CarrierPoint& at;
  const scene::TriangleMesh& mesh;
};

// Decided in rationals where doubles with error bounds do not tell. The weights have to be positive and to sum to 2^60; `bound` is finite.
bool is_within(const WeightedPoint& point, const std::array<scene::Point, 3>& triangle, double bound);

// Whether `at` is the point, but for the rounding of the sum of three products in doubles, or, `single`, of the result to a float.
bool is_rounded_from(const WeightedPoint& point, const scene::Point& at, bool single);

std::array<scene::Point, 3> corners_of(const scene::TriangleMesh& mesh, std::uint32_t triangle);

}  // namespace clues::validate
