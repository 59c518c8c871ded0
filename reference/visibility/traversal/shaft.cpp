#include "reference/visibility/traversal/shaft.h"

#include <algorithm>

#include "exact/cell/direction_cone.h"

namespace clues::reference {

using exact::Point3;

namespace {

std::vector<Point3> with_cell(std::span<const Point3> corners, const exact::ConvexCell& cell) {
  std::vector<Point3> points(corners.begin(), corners.end());
  points.insert(points.end(), cell.vertices().begin(), cell.vertices().end());
  return points;
}

}  // namespace

Shaft::Shaft(std::span<const Point3> corners, const exact::ConvexCell& cell) : hull_(with_cell(corners, cell)) {
  for (const Point3& p : hull_.vertices()) box_ += p.bbox();
}

bool Shaft::is_entered_by(std::span<const Point3> polygon) const {
  if (hull_.dimension() < 3) return false;
  CGAL::Bbox_3 box;
  for (const Point3& p : polygon) box += p.bbox();
  if (!CGAL::do_overlap(box_, box)) return false;
  std::vector<Point3> rest(polygon.begin(), polygon.end());
  for (const exact::CellFacet& f : hull_.facets()) {
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const Point3& p) { return f.plane.oriented_side(p) == CGAL::ON_ORIENTED_BOUNDARY; }))
      return false;
    rest = exact::clipped(rest, f.plane.opposite());
    if (rest.size() < 3) return false;
  }
  return true;
}

bool Shaft::holds(std::span<const Point3> polygon) const {
  return std::all_of(polygon.begin(), polygon.end(), [&](const Point3& p) { return hull_.contains(p); });
}

std::vector<std::vector<Point3>> Shaft::cut(const std::vector<Point3>& polygon) const {
  if (!is_entered_by(polygon)) return {polygon};
  std::vector<std::vector<Point3>> parts;
  std::vector<Point3> rest = polygon;
  for (const exact::CellFacet& f : hull_.facets()) {
    const bool sticks_out = std::any_of(
        rest.begin(), rest.end(), [&](const Point3& p) { return f.plane.oriented_side(p) == CGAL::ON_POSITIVE_SIDE; });
    if (!sticks_out) continue;
    parts.push_back(exact::clipped(rest, f.plane));
    rest = exact::clipped(rest, f.plane.opposite());
    for (std::vector<Point3>* part : {&parts.back(), &rest}) {
      for (Point3& p : *part) p = exact::collapsed(p);
    }
  }
  parts.push_back(std::move(rest));
  return parts;
}

}  // namespace clues::reference
