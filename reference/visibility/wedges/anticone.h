// D12: the facets of the anti-cone A(x) of a point x outside the cell, or on its relative border. Each is a planar sector with apex x, spanned by the
// reflections of two extreme cell vertices (a silhouette edge of V seen from x); its plane supports V.
//
// All facets are found by plane sides alone: no sweep along the cell's contour, so no start, no direction and no
// order to get wrong (hazards B-1, B-3, B-4).
#pragma once

#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"

namespace clues::reference {

struct AnticoneFacet {
  exact::Plane3 plane;        // V in the closed negative side H+
  exact::Vector3 ray0, ray1;  // x - s0, x - s1; counter-clockwise about the plane's normal
};

// x may lie on the border of a solid cell or of a polygon: then the facets are parts of the planes of V's facets at x, or of either side of the polygon's plane.
// Empty when x lies inside V, or in the line of a segment, or V is a point: then A(x) is nothing, a ray, or all of the polygon's plane, with V on every side of x.
// O(cell edges * cell vertices).
std::vector<AnticoneFacet> anticone_facets(const exact::Point3& x, const exact::ConvexCell& cell);

// D17: the anti-cones of the apexes whose wedges a limit left out. What those wedges could show, and all that follows from it, lies in the closed anti-cones: if y is in A(x), A(y) is. So a
// label that a walk finds is right for a whole figure only if no anti-cone reaches the figure; one sample outside says nothing about the rest.
class LeftOut {
 public:
  void add(const exact::Point3& x, const exact::ConvexCell& cell);
  void clear() { anticones_.clear(); }
  std::size_t size() const { return anticones_.size(); }
  bool empty() const { return anticones_.empty(); }
  // Whether one may reach the hull of these points: false only if each has a facet's plane that keeps it out. O(apexes * facets * corners).
  bool may_reach(const std::vector<exact::Point3>& corners) const;

 private:
  std::vector<std::vector<exact::Plane3>> anticones_;  // by their facets
};

}  // namespace clues::reference
