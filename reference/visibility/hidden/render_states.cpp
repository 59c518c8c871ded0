#include "reference/visibility/hidden/render_states.h"

#include <algorithm>
#include <optional>

#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"

namespace clues::reference {

using exact::Plane3;
using exact::Point3;

namespace {

struct Shaft {
  exact::ConvexCell hull;
  CGAL::Bbox_3 box;
};

Plane3 plane_of(const VisibilityMap& map, const Region& r) {
  const Plane3& plane = map.complex.planes[r.piece];
  return r.front ? plane : plane.opposite();
}

CGAL::Bbox_3 box_of(const std::vector<Point3>& points) {
  CGAL::Bbox_3 box;
  for (const Point3& p : points) box += p.bbox();
  return box;
}

// The region, and the part of the cell on the closed side in front of it.
Shaft shaft_of(const VisibilityMap& map, const Region& r) {
  const Plane3 front = plane_of(map, r);
  std::vector<Point3> points = r.rings[0];
  const std::vector<Point3>& cell = map.cell.vertices();
  for (const Point3& s : cell) {
    if (front.oriented_side(s) != CGAL::ON_NEGATIVE_SIDE) points.push_back(s);
  }
  for (const auto& [i, j] : map.cell.edges()) {
    const Point3 &a = cell[static_cast<std::size_t>(i)], &b = cell[static_cast<std::size_t>(j)];
    if (front.oriented_side(a) * front.oriented_side(b) < 0) points.push_back(exact::crossing(front, a, b));
  }
  return {exact::ConvexCell(points), box_of(points)};
}

// Whether the convex polygon meets the open hull: a relatively inner point of what the two share is inside if any point of it is.
bool meets(std::vector<Point3> polygon, const exact::ConvexCell& hull) {
  for (const exact::CellFacet& f : hull.facets()) {
    polygon = exact::clipped(polygon, f.plane.opposite());
    if (polygon.empty()) return false;
  }
  exact::Vector3 sum = CGAL::NULL_VECTOR;
  for (const Point3& p : polygon) sum = sum + (p - CGAL::ORIGIN);
  return hull.interior_contains(CGAL::ORIGIN + sum / exact::FT(static_cast<int>(polygon.size())));
}

}  // namespace

std::vector<RenderState> render_states(const VisibilityMap& map) {
  const exact::Complex& complex = map.complex;
  std::vector<std::vector<Point3>> surfaces;
  std::vector<CGAL::Bbox_3> surface_boxes;
  for (const exact::Piece& piece : complex.pieces) {
    surfaces.push_back(
        {complex.points[piece.corners[0]], complex.points[piece.corners[1]], complex.points[piece.corners[2]]});
    surface_boxes.push_back(box_of(surfaces.back()));
  }
  std::vector<RenderState> states(map.regions.size());
  std::vector<std::size_t> drawn;
  std::vector<std::optional<Shaft>> shafts(map.regions.size());
  for (std::size_t i = 0; i < map.regions.size(); ++i) {
    const Region& r = map.regions[i];
    const Plane3 front = plane_of(map, r);
    const auto& cell = map.cell.vertices();
    const auto before = [&](const Point3& s) { return front.oriented_side(s) == CGAL::ON_POSITIVE_SIDE; };
    if (!r.visible) continue;
    drawn.push_back(i);
    if (std::none_of(cell.begin(), cell.end(), before)) continue;  // inside the cell, edge-on: no shaft, and no labels
    shafts[i] = shaft_of(map, r);
    states[i].no_backface_cull = std::all_of(cell.begin(), cell.end(), before);
    bool clear = true;
    for (std::size_t t = 0; t < surfaces.size() && clear; ++t)
      clear = !CGAL::do_overlap(surface_boxes[t], shafts[i]->box) || !meets(surfaces[t], shafts[i]->hull);
    states[i].no_z_compare = clear;
  }
  for (const std::size_t i : drawn) {
    const exact::ConvexCell around(map.regions[i].rings[0]);  // its own convex hull, a polygon
    const std::vector<Point3> outline = exact::corners_of(around, around.facets()[0]);
    const CGAL::Bbox_3 box = box_of(outline);
    states[i].no_z_write = shafts[i].has_value() && std::all_of(drawn.begin(), drawn.end(), [&](std::size_t k) {
                             if (k == i) return true;
                             if (!shafts[k]) return false;
                             return !CGAL::do_overlap(box, shafts[k]->box) || !meets(outline, shafts[k]->hull);
                           });
  }
  return states;
}

std::vector<std::string> names_of(const RenderState& state) {
  std::vector<std::string> names;
  if (state.no_backface_cull) names.emplace_back("NO_BACKFACE_CULL");
  if (state.no_z_compare) names.emplace_back("NO_Z_COMPARE");
  if (state.no_z_write) names.emplace_back("NO_Z_WRITE");
  return names;
}

}  // namespace clues::reference
