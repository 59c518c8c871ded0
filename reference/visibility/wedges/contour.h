// D10, D11: the edges that carry SV-ME and SE-ME wedges, and the supporting planes through them (FIG. 3, FIG. 4C).
//
// No angles and no corner tests: a plane through the edge supports the cell when all of V is in its closed H+ and it touches V;
// the edge is a contour edge for that plane when every incident piece is in H+ as well. This one rule covers closed
// solids, open sheets, boundary edges and non-manifold edges, and with the closed H+ also reflex edges
// (hazards B-2, B-5, B-7, B-8, B-16, B-27).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/kernel.h"

namespace clues::reference {

// An edge with one of its supporting planes.
struct ContourEdge {
  std::uint32_t edge = 0;
  exact::Plane3 plane;        // V in the closed negative side H+
  std::vector<int> touching;  // cell vertices on the plane: one (SV-ME), or an edge or facet of V (SE-ME)
  std::optional<std::uint32_t>
      cover;                // a piece lying in the plane between the edge and V: it covers the near side of the edge
  bool holds_cell = false;  // all of V lies in the plane: its wedges only separate (T10)
};

// Of points that span at most a half turn about the line ab, the index of the last in that sense; none if all are on the line.
std::optional<std::size_t> last_about(const exact::Point3& a, const exact::Point3& b,
                                      const std::vector<exact::Point3>& points, CGAL::Orientation turn);

// The supporting planes of V through the line ab, each oriented with V in the closed negative side: up to two, none when the line
// meets int V. A line that only touches V has them too (a box that leans on the cell: the definition's D10 says it has none, and
// then hides what is visible). If the plane meets V on both sides of the line it is given once for each side.
struct SupportingPlane {
  exact::Plane3 plane;
  std::vector<int> touching;
};
std::vector<SupportingPlane> supporting_planes(const exact::Point3& a, const exact::Point3& b,
                                               const exact::ConvexCell& cell);

// All contour edges of the complex, by edge. O(edges * cell vertices).
std::vector<ContourEdge> contour_edges(const exact::Complex& complex, const exact::ConvexCell& cell);

}  // namespace clues::reference
