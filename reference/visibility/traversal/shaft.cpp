#include "reference/visibility/traversal/shaft.h"

#include <algorithm>

#include "exact/direction_cone.h"

namespace clues::reference {

using exact::Point3;

namespace {

std::vector<Point3> with_cell(const exact::TriangleCorners& triangle, const exact::ConvexCell& cell) {
  std::vector<Point3> points(triangle.begin(), triangle.end());
  points.insert(points.end(), cell.vertices().begin(), cell.vertices().end());
  return points;
}

}  // namespace

Shaft::Shaft(const exact::TriangleCorners& triangle, const exact::ConvexCell& cell) : hull_(with_cell(triangle, cell)) {
  for (const Point3& p : hull_.vertices()) box_ += p.bbox();
}

bool Shaft::is_entered_by(const exact::TriangleCorners& triangle) const {
  if (hull_.dimension() < 3) return false;
  if (!CGAL::do_overlap(box_, triangle[0].bbox() + triangle[1].bbox() + triangle[2].bbox())) return false;
  std::vector<Point3> rest(triangle.begin(), triangle.end());
  for (const exact::CellFacet& f : hull_.facets()) {
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](const Point3& p) { return f.plane.oriented_side(p) == CGAL::ON_ORIENTED_BOUNDARY; }))
      return false;
    rest = exact::clipped(rest, f.plane.opposite());
    if (rest.size() < 3) return false;
  }
  return true;
}

bool Shaft::holds(const exact::TriangleCorners& triangle) const {
  return std::all_of(triangle.begin(), triangle.end(), [&](const Point3& p) { return hull_.contains(p); });
}

}  // namespace clues::reference
