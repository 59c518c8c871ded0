// What those who shoot sight lines in campaigns have in common: where lines go, and what one that meets a triangle proves.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/sight/point_occlusion.h"
#include "fuzz/generators/random.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::fuzz {

// a + t (b - a), rounded.
scene::Point on_line(const scene::Point& a, const scene::Point& b, double t);

// A mean of the points, at random; one in three weighs `heavy` times as much. Rounded: it may be off the plane of points in one.
scene::Point random_mean(const std::vector<scene::Point>& points, int heavy, Random& random);

// Nothing, an ulp, or 2^-10 to 2^-40 in some coordinates.
scene::Point off_by_a_little(scene::Point p, Random& random);

// From v to where the line through `end` crosses the inside of the triangle with this number, D5; none on its border, and where the line does not cross its plane.
std::optional<validate::Witness> witness_on(std::uint32_t triangle, const exact::TriangleCorners& corners,
                                            const exact::Point3& v, const exact::Point3& end);

}  // namespace clues::fuzz
