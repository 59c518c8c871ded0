// The four constraints of a depth mesh at one viewpoint (D29), exactly: no tolerance, no root, no angle. Rows of one viewpoint.
// Whatever is degenerate (the viewpoint on a sample or on the inside of an edge's separation) violates.
#pragma once

#include "exact/motion/sight_row.h"
#include "exact/motion/signed_roots.h"

namespace clues::exact {

// The thresholds as ratios of whole numbers; both denominators are positive.
struct ExactThresholds {
  explicit ExactThresholds(const scene::MotionThresholds& thresholds);  // finite; 0 <= sigma <= 1
  mpq_class kappa, sigma;
};

// The sign of det(a, b, c): 1 where the triangle faces the viewpoint.
int facing_sign(const SightRow& a, const SightRow& b, const SightRow& c);

// Whether a and b are seen at least phi apart: kappa * |a x b| >= a.b
bool edge_length_holds(const SightRow& a, const SightRow& b, const ExactThresholds& thresholds);

// Whether p is seen at least eps from every point of the edge from a to b, its ends included.
bool separation_holds(const SightRow& p, const SightRow& a, const SightRow& b, const ExactThresholds& thresholds);

// The sign of G: 1 when d lies strictly outside of the cap through the front facing triangle a, b, c (the edge is locally Delaunay), 0 when the four
// are cocircular, -1 when the edge has to be flipped. The constraint holds where it is not negative. Does not depend on which of
// the two triangles at the edge is a, b, c.
int delaunay_sign(const SightRow& a, const SightRow& b, const SightRow& c, const SightRow& d);

}  // namespace clues::exact
