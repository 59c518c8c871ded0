// D14, D18, FIG. 25: can a single point be seen from the cell? Decided against all of the cell, with a proof either way: a sight line, or triangles that cover
// the cell when it is looked at from the point. Beside it stands what the first-order method says (Omega).
//
// A point of space has one answer. A point of surfaces has one for each triangle that it lies on and each side: the last bit of the sight line is then
// strictly on that side of the triangle's plane. So a point of an edge or vertex has the answers of all triangles around it. A point of the closed cell is seen.
// On the border of regions the first-order answer is "visible" if any of the regions that meet there is: the map's regions count as closed. The same
// holds in space, on event surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "exact/sight/point_occlusion.h"
#include "reference/visibility/map/omega.h"
#include "scene/mesh/mesh.h"

namespace clues::validate {

struct PointAnswer {
  std::optional<std::uint32_t> triangle;  // none: a point of space
  bool front = true;                      // side of the triangle
  std::optional<exact::Point3>
      v;  // visible: in int V, and the open segment (v,p) is free (D5), also from all of int V near v
  std::vector<std::uint32_t> covered_by;  // occluded: no triangle of these can be left out, unless the side faces away
  bool faces_away = false;                // occluded, because no point of V is strictly on that side
  bool first_order = true;                // in Omega, or on its border
  bool fallback = false;                  // in Omega only because of a limit (D17)
  bool contradiction = false;             // visible and yet not in Omega: must not happen (T1)
};

struct PointReport {
  bool in_cell = false;  // then there are no answers
  std::vector<PointAnswer> answers;
};

class PointQuery {
 public:
  // Keeps references. All coordinates, the mesh's too, are in the range of omega (omega.map().range).
  // `bounds`: a box around all points that will be asked for. Solid mode: fronts only (D4).
  PointQuery(const scene::TriangleMesh& mesh, const reference::Omega& omega, const CGAL::Bbox_3& bounds);

  // Throws Error internal if two oracles contradict each other on the way. One pass of plain rationals over all triangles for each triangle that
  // gets in the way.
  PointReport ask(const exact::Point3& p) const;
  // The same at a point p of the hull of `corners`, which nothing cuts: in space it is in Omega, too, if what a limit left out may show any of it (D17).
  PointReport ask(const exact::Point3& p, const std::vector<exact::Point3>& corners) const;

 private:
  PointAnswer look(const exact::Point3& p, const std::optional<exact::Plane3>& side) const;
  bool in_visible_region(std::uint32_t triangle, bool front, const exact::Point3& p) const;

  const scene::TriangleMesh& mesh_;
  const reference::Omega& omega_;
  reference::SpaceLabels labels_;
  std::vector<exact::TriangleCorners> corners_;                             // per triangle
  std::vector<std::optional<exact::Plane3>> planes_;                        // none: no area
  std::vector<std::array<std::vector<std::uint32_t>, 2>> visible_regions_;  // per triangle: of the back, of the front
};

}  // namespace clues::validate
