#include "reference/visibility/refinement/retraction.h"

#include <algorithm>

#include "reference/visibility/wedges/contour.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point3;

bool runs_into_surface(const exact::Complex& complex, std::uint32_t edge, const Plane3& plane) {
  bool before = false, behind = false;
  for (const std::uint32_t t : complex.edges[edge].pieces) {
    for (const std::uint32_t c : complex.pieces[t].corners) {
      if (c == complex.edges[edge].a || c == complex.edges[edge].b) continue;
      const auto side = plane.oriented_side(complex.points[c]);
      before |= side == CGAL::ON_POSITIVE_SIDE;
      behind |= side == CGAL::ON_NEGATIVE_SIDE;
    }
  }
  return before && behind;
}

std::optional<ContourSegment> nearer_edge(const exact::Complex& complex, const ContourSegment& segment,
                                          const exact::ConvexCell& cell) {
  const Point3 own_middle = CGAL::midpoint(segment.lo, segment.hi);
  FT nearest = CGAL::squared_distance(own_middle, cell.center());
  std::optional<std::uint32_t> found;
  for (const std::uint32_t t : complex.edges[segment.edge].pieces) {
    for (const std::uint32_t e : complex.piece_edges[t]) {
      const auto& edge = complex.edges[e];
      const FT distance =
          CGAL::squared_distance(CGAL::midpoint(complex.points[edge.a], complex.points[edge.b]), cell.center());
      if (e == segment.edge || distance >= nearest) continue;
      nearest = distance;
      found = e;
    }
  }
  if (!found) return std::nullopt;
  const Point3 a = complex.points[complex.edges[*found].a], b = complex.points[complex.edges[*found].b];
  // Of the up to two supporting planes the one that is turned least from the segment's own.
  const exact::Vector3 own = segment.plane.orthogonal_vector();
  const auto likeness = [&](const SupportingPlane& s) {
    const exact::Vector3 n = s.plane.orthogonal_vector();
    return (n * own) * CGAL::abs(n * own) / n.squared_length();
  };
  const std::vector<SupportingPlane> planes = supporting_planes(a, b, cell);
  const auto best = std::max_element(planes.begin(), planes.end(),
                                     [&](const auto& x, const auto& y) { return likeness(x) < likeness(y); });
  if (best == planes.end()) return std::nullopt;
  return ContourSegment{*found, std::min(a, b), std::max(a, b), best->plane,
                        cell.vertices()[static_cast<std::size_t>(best->touching.front())]};
}

}  // namespace clues::reference
