// D2: the view cell V as an exact convex polytope: any dimension from 0 (a point) to 3.
#pragma once

#include <array>
#include <vector>

#include "exact/kernel.h"

namespace clues::exact {

// One facet of a 3-dimensional cell, or the polygon itself (once) for a 2-dimensional one.
struct CellFacet {
  std::vector<int> corners;  // vertex indices, counter-clockwise seen from outside
  Plane3 plane;              // outward normal; for a flat cell the normal of the given orientation
};

class ConvexCell {
 public:
  // The hull of the points; they may repeat or lie inside. At least one point. O(n log n) expected.
  explicit ConvexCell(const std::vector<Point3>& points);
  static ConvexCell from_doubles(const std::vector<scene::Point>& points);

  int dimension() const { return dimension_; }                             // 0..3
  const std::vector<Point3>& vertices() const { return vertices_; }        // extreme points only
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }  // true edges (coplanar triangles are merged)
  const std::vector<CellFacet>& facets() const { return facets_; }         // dimension 3: all; 2: one; else none

  // Whether x lies in V / in int V (relative interior). O(facets).
  bool contains(const Point3& x) const;
  bool interior_contains(const Point3& x) const;

  // The centroid of the vertices: a point of int V.
  const Point3& center() const { return center_; }

  // A point of int V: the convex combination with the given positive weights, one per vertex.
  Point3 interior_point(const std::vector<int>& weights) const;
  Point3 interior_point(const std::vector<double>& weights) const;

 private:
  int dimension_ = 0;
  std::vector<Point3> vertices_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<CellFacet> facets_;
  Point3 center_;
};

}  // namespace clues::exact
