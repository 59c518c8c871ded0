// The exact motion bounds (D29): how far the viewpoint may move from v before a triangle is edge-on (d_i), or an edge is seen shorter than
// phi (d_e). They are algebraic numbers that are never formed: compared with a radius s whose square is rational instead.
#pragma once

#include "exact/motion/constraints.h"

namespace clues::exact {

// Where the nearest violation of an edge length lies, as seen in the half plane through edge and viewpoint.
enum class EdgeBranch {
  violated,      // already at v: the bound is 0
  end_point,     // I1: an end of the edge is nearest
  tube,          // I2: the surface of the spindle torus is nearest
  cone_side,     // one end is a direction: the side of the cone
  cone_apex,     // one end is a direction: its apex, which is the other end
  never_changes  // both ends are directions, and the constraint holds: no bound
};

// The sign of d - s, with s = sqrt(s_squared); d = 0 when the constraint is violated at v, and infinite when it can never be.
// Points of the samples and of v are taken exactly.
int compare_facing_bound(const scene::DepthSample& a, const scene::DepthSample& b, const scene::DepthSample& c,
                         const ExactViewpoint& v, const mpq_class& s_squared);

int compare_edge_bound(const scene::DepthSample& a, const scene::DepthSample& b, const ExactViewpoint& v,
                       const ExactThresholds& thresholds, const mpq_class& s_squared);

EdgeBranch edge_branch(const scene::DepthSample& a, const scene::DepthSample& b, const ExactViewpoint& v,
                       const ExactThresholds& thresholds);

}  // namespace clues::exact
