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
//
// A walk from a point outside keeps outside: where a leg, a part of a sight line, crosses a wedge that is not there, all that is behind it on the line is in the anti-cone. Only the last leg
// of a walk that ends in a groove or a corner (walk.h) is no part of a sight line. Where that runs through an anti-cone the walk says nothing.
//
// Sources are such figures, too: a part of an edge, known by one of its points. A missing wedge may end one label within it; then its own wedges may be missing, or be there in error, without
// being in an anti-cone. It is right if the anti-cone misses all of it, or if it runs into the anti-cone at one end and stays there, and its point is outside; and if its walk says something. It
// does not matter if it lies in the anti-cone as a whole. Any other source is left out as well, with what holds the anti-cones of all its points.
class LeftOut {
 public:
  void add(const exact::Point3& x, const exact::ConvexCell& cell);
  // The anti-cones of all points between lo and hi, a part of a contour edge: what holds them all. All of V is on the negative side of `supporting`, a plane through the edge.
  void add(const exact::Point3& lo, const exact::Point3& hi, const exact::Plane3& supporting,
           const exact::ConvexCell& cell);
  std::size_t size() const { return anticones_.size(); }
  bool empty() const { return anticones_.empty(); }
  // Whether one may reach the hull of these points: false only if each has a facet's plane that keeps it out. O(apexes * facets * corners).
  bool may_reach(const std::vector<exact::Point3>& corners) const;
  // Of number i: whether it meets the closed segment, and whether it holds the point. O(facets).
  bool meets(std::size_t i, const exact::Point3& a, const exact::Point3& b) const;
  bool holds(std::size_t i, const exact::Point3& x) const;

 private:
  std::vector<std::vector<exact::Plane3>> anticones_;  // by their facets
};

}  // namespace clues::reference
