// A sample as a viewpoint sees it: the vector from the viewpoint to the sample, or the direction, times any positive number that makes
// it whole. Every constraint of D29 is a sign that such factors do not change (facing and Delaunay: one factor a row; edge length
// and separation: as they are about angles), so that points and directions are treated alike from here on.
#pragma once

#include <gmpxx.h>

#include <array>

#include "scene/motion/depth_mesh.h"

namespace clues::exact {

// Any point of space with rational coordinates.
using ExactViewpoint = std::array<mpq_class, 3>;
// Doubles are taken exactly; they must be finite.
ExactViewpoint exact_viewpoint(const scene::MotionPoint& at);

struct SightRow {
  std::array<mpz_class, 3> x;
  mpz_class square;  // |x|^2; 0: the viewpoint stands on the sample
};

SightRow sight_row(const scene::DepthSample& sample, const scene::MotionPoint& viewpoint);
SightRow sight_row(const scene::DepthSample& sample, const ExactViewpoint& viewpoint);

// det(a, b, c)
mpz_class determinant(const SightRow& a, const SightRow& b, const SightRow& c);
mpz_class dot(const SightRow& a, const SightRow& b);

}  // namespace clues::exact
