// D10, D11 by exact plane sides.
#include "reference/visibility/contour.h"

#include <algorithm>

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

// For x in a plane through ab with normal n: which side of the line ab, +1 left of a->b seen from the tip of n.
CGAL::Sign beside(const Point3& a, const Point3& b, const Vector3& n, const Point3& x) {
  return CGAL::sign(n * CGAL::cross_product(b - a, x - a));
}

}  // namespace

std::vector<SupportingPlane> supporting_planes(const Point3& a, const Point3& b, const exact::ConvexCell& cell) {
  const std::vector<Point3>& s = cell.vertices();
  for (const Point3& v : s) {
    if (CGAL::collinear(a, b, v)) return {};
  }
  // Seen along the line, V spans less than a half turn unless the line meets it; its two ends are found by comparison.
  const auto end = [&](CGAL::Orientation turn) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < s.size(); ++i) {
      if (CGAL::orientation(a, b, s[best], s[i]) == turn) best = i;
    }
    return best;
  };
  std::vector<SupportingPlane> planes;
  for (const CGAL::Orientation turn : {CGAL::POSITIVE, CGAL::NEGATIVE}) {
    const std::size_t m = end(turn);
    SupportingPlane found;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const CGAL::Orientation o = CGAL::orientation(a, b, s[m], s[i]);
      if (o == turn) return {};  // no end: the line passes through V
      if (o == CGAL::COPLANAR) found.touching.push_back(static_cast<int>(i));
    }
    found.plane = turn == CGAL::POSITIVE ? exact::Plane3(a, b, s[m]) : exact::Plane3(b, a, s[m]);
    const Vector3 n = found.plane.orthogonal_vector();
    const CGAL::Sign side = beside(a, b, n, s[m]);
    for (const int i : found.touching) {
      if (beside(a, b, n, s[static_cast<std::size_t>(i)]) != side)
        return {};  // V reaches both sides of the line: it meets V
    }
    planes.push_back(std::move(found));
  }
  return planes;
}

std::vector<ContourEdge> contour_edges(const exact::Complex& complex, const exact::ConvexCell& cell) {
  std::vector<ContourEdge> contour;
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const exact::Edge& edge = complex.edges[e];
    const Point3 &a = complex.points[edge.a], &b = complex.points[edge.b];
    for (SupportingPlane& support : supporting_planes(a, b, cell)) {
      const Vector3 n = support.plane.orthogonal_vector();
      const CGAL::Sign cell_side = beside(a, b, n, cell.vertices()[static_cast<std::size_t>(support.touching.front())]);
      ContourEdge found{e, support.plane, support.touching, std::nullopt};
      bool in_h_plus = true, beyond = false;
      for (const std::uint32_t t : edge.pieces) {
        const auto& c = complex.pieces[t].corners;
        const auto third = std::find_if(c.begin(), c.end(), [&](auto i) { return i != edge.a && i != edge.b; });
        const Point3& x = complex.points[*third];
        const CGAL::Oriented_side o = support.plane.oriented_side(x);
        if (o == CGAL::ON_POSITIVE_SIDE) {
          in_h_plus = false;
          break;
        }
        if (o == CGAL::ON_ORIENTED_BOUNDARY) {
          if (beside(a, b, n, x) == cell_side) {
            found.cover = t;
          } else {
            beyond = true;
          }
        }
      }
      // With the plane's surface on both sides the edge is a seam inside a flat surface: a wedge that reaches it runs on over it.
      if (in_h_plus && !(found.cover && beyond)) contour.push_back(std::move(found));
    }
  }
  return contour;
}

}  // namespace clues::reference
