// The four motion bounds (D29) of a triangle, an edge, a vertex and its opposite edge, two triangles at an edge, at a viewpoint v: no
// viewpoint nearer to v than the bound violates the constraint. 0 when it is violated at v; infinite when it never is.
// facing_bound and edge_bound are the largest doubles not above the distance to the nearest violation; separation_bound (T8) and
// delaunay_bound (T9) are lower bounds, proved by enclosures.
#pragma once

#include "exact/motion/compare_bounds.h"

namespace clues::reference {

using exact::ExactThresholds;
using exact::ExactViewpoint;
using scene::DepthSample;

double facing_bound(const DepthSample& a, const DepthSample& b, const DepthSample& c, const ExactViewpoint& v);
double edge_bound(const DepthSample& a, const DepthSample& b, const ExactViewpoint& v,
                  const ExactThresholds& thresholds);
// Of p against the edge ab of the triangle a, b, p.
double separation_bound(const DepthSample& a, const DepthSample& b, const DepthSample& p, const ExactViewpoint& v,
                        const ExactThresholds& thresholds);
// Of the triangle a, b, c and the vertex d across one of its edges.
double delaunay_bound(const DepthSample& a, const DepthSample& b, const DepthSample& c, const DepthSample& d,
                      const ExactViewpoint& v);

// What T9 has: the best of three forms. For tests and figures.
struct DelaunayForms {
  double general = 0;     // form 1: any samples
  double quadrangle = 0;  // form 2: four points, the best of four orders
  double ball = 0;        // form 3: any samples
};
DelaunayForms delaunay_forms(const DepthSample& a, const DepthSample& b, const DepthSample& c, const DepthSample& d,
                             const ExactViewpoint& v);

}  // namespace clues::reference
