// The area of a triangle as a double: a square root, and so rounded. Everything under the root is computed exactly; what is left is a relative error
// below 2^-50 for each triangle (overflow and underflow of doubles apart).
#pragma once

#include <cstdint>

#include "scene/mesh/mesh.h"

namespace clues::validate {

double area_estimate(const scene::TriangleMesh& mesh, std::uint32_t triangle);

}  // namespace clues::validate
