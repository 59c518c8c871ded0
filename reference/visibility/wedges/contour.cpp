// D10, D11 by exact plane sides.
#include "reference/visibility/wedges/contour.h"

#include <algorithm>

#include "exact/cell/cell_plane.h"

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

// For x in a plane through ab with normal n: which side of the line ab, +1 left of a->b seen from the tip of n.
CGAL::Sign beside(const Point3& a, const Point3& b, const Vector3& n, const Point3& x) {
  return CGAL::sign(n * CGAL::cross_product(b - a, x - a));
}

}  // namespace

std::optional<std::size_t> last_about(const Point3& a, const Point3& b, const std::vector<Point3>& points,
                                      CGAL::Orientation turn) {
  std::optional<std::size_t> last;
  // Twice: the ends of a half turn are not told apart, so that one may be passed over the first time.
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((!last || CGAL::orientation(a, b, points[*last], points[i]) == turn) && !CGAL::collinear(a, b, points[i]))
        last = i;
    }
  }
  return last;
}

std::vector<SupportingPlane> supporting_planes(const Point3& a, const Point3& b, const exact::ConvexCell& cell) {
  const std::vector<Point3>& s = cell.vertices();
  std::vector<std::size_t> off_line;  // the line may touch V in a vertex or an edge
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!CGAL::collinear(a, b, s[i])) off_line.push_back(i);
  }
  if (off_line.empty()) return {};
  // Seen along the line, V spans at most a half turn unless the line passes through int V; its ends are found by comparison.
  std::vector<SupportingPlane> planes;
  for (const CGAL::Orientation turn : {CGAL::POSITIVE, CGAL::NEGATIVE}) {
    const std::size_t m = *last_about(a, b, s, turn);
    const exact::Plane3 plane = turn == CGAL::POSITIVE ? exact::Plane3(a, b, s[m]) : exact::Plane3(b, a, s[m]);
    const Vector3 n = plane.orthogonal_vector();
    // The touching vertices, by the side of the line they are on. On both sides only if the line runs through a facet of V.
    std::vector<int> left, right;
    for (const std::size_t i : off_line) {
      const CGAL::Orientation o = CGAL::orientation(a, b, s[m], s[i]);
      if (o == turn) return {};  // no end: the line passes through V
      if (o != CGAL::COPLANAR) continue;
      (beside(a, b, n, s[i]) == CGAL::POSITIVE ? left : right).push_back(static_cast<int>(i));
    }
    for (const auto& touching : {left, right}) {
      if (!touching.empty()) planes.push_back({plane, touching});
    }
    // Then both ends of V lie in this one plane, unless all of V does and both ways round count.
    if (!left.empty() && !right.empty() && left.size() + right.size() < off_line.size()) break;
  }
  return planes;
}

std::vector<ContourEdge> contour_edges(const exact::Complex& complex, const exact::ConvexCell& cell) {
  std::vector<ContourEdge> contour;
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const exact::Edge& edge = complex.edges[e];
    if (edge.pieces.empty()) continue;  // of a part of a complex
    const Point3 &a = complex.points[edge.a], &b = complex.points[edge.b];
    for (SupportingPlane& support : supporting_planes(a, b, cell)) {
      const Vector3 n = support.plane.orthogonal_vector();
      const CGAL::Sign cell_side = beside(a, b, n, cell.vertices()[static_cast<std::size_t>(support.touching.front())]);
      ContourEdge found{e, support.plane, support.touching, std::nullopt, exact::lies_in(cell, support.plane)};
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
      if (!in_h_plus || (found.cover && beyond)) continue;
      // From a cell in that plane sight lines to the edge run just off the surface, which does not cover it then.
      if (found.holds_cell) found.cover.reset();
      contour.push_back(std::move(found));
    }
  }
  return contour;
}

}  // namespace clues::reference
