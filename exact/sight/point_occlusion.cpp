// The point-occlusion oracle (D18). Directions that reach V through one of its front facets are a convex cone; a piece of it is
// searched by an interior sight line: free, or blocked by a triangle whose shadow is then cut out of the piece.
#include "exact/sight/point_occlusion.h"

#include <algorithm>
#include <utility>

#include "exact/cell/cell_plane.h"
#include "exact/cell/direction_cone.h"
#include "exact/sight/planar_occlusion.h"
#include "exact/sight/sight_segment.h"
#include "scene/messages/error.h"

namespace clues::exact {
namespace {

bool allowed(const std::optional<Plane3>& side, const Point3& v) {
  return !side || side->oriented_side(v) == CGAL::ON_POSITIVE_SIDE;
}

// A point of int V strictly on the positive side: next to a vertex that is there.
std::optional<Point3> interior_point_on_side(const ConvexCell& cell, const std::optional<Plane3>& side) {
  const auto& vertices = cell.vertices();
  const auto at = std::find_if(vertices.begin(), vertices.end(), [&](const Point3& v) { return allowed(side, v); });
  if (at == vertices.end()) return std::nullopt;
  Point3 v = cell.center();
  while (!allowed(side, v)) v = CGAL::midpoint(v, *at);
  return v;
}

class ConeSearch {
 public:
  ConeSearch(const Point3& p, const ConvexCell& cell, const std::vector<TriangleCorners>& triangles)
      : p_(p), cell_(cell), triangles_(triangles), solid_(cell.dimension() == 3) {}

  // v in int V seen from p through the facet, on the positive side.
  std::optional<Point3> search(const Plane3& plane, const std::vector<Point3>& corners,
                               const std::optional<Plane3>& side) {
    std::optional<DirectionCone> start = cone_of(corners, p_);
    if (start && side) start = clipped(*start, side->orthogonal_vector());
    if (!start) return std::nullopt;
    plane_ = plane;
    shadows_.assign(triangles_.size(), std::nullopt);
    std::vector<DirectionCone> pieces{std::move(*start)};
    while (!pieces.empty()) {
      const DirectionCone piece = std::move(pieces.back());
      pieces.pop_back();
      Vector3 direction;
      const DirectionCone* shadow = nullptr;
      // A triangle whose shadow is flat, or that stands behind a flat cell, can spoil this line, but not the
      // piece: take another line.
      for (int t = 1; !shadow; ++t) {
        direction = interior_direction(piece, t);
        bool blocked = false;
        shadow = best_shadow(piece, entry(direction), blocked);
        if (!blocked) return beyond(direction);
      }
      // The line blocked is in the shadow and inside the piece, so something is taken away and the search ends.
      if (!contains(*shadow, direction)) {
        throw scene::Error(scene::ErrorCode::internal, "point_occlusion: a shadow misses the line that it blocks");
      }
      for (DirectionCone& part : difference(piece, *shadow)) pieces.push_back(std::move(part));
    }
    return std::nullopt;
  }

 private:
  // Of the triangles that block the line from p to `end`, the shadow that covers most of the piece; null if all are flat.
  const DirectionCone* best_shadow(const DirectionCone& piece, const Point3& end, bool& blocked) {
    const DirectionCone* best = nullptr;
    std::size_t best_count = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (!blocks(triangles_[i], end, solid_, p_) && !stands_at(triangles_[i], end)) continue;
      blocked = true;
      if (!shadows_[i]) {
        shadows_[i] = cone_of(clipped({triangles_[i].begin(), triangles_[i].end()}, plane_), p_);
      }
      if (!*shadows_[i]) continue;
      const std::size_t count = rays_inside(piece, **shadows_[i]);
      if (!best || count > best_count) {
        best = &**shadows_[i];
        best_count = count;
      }
      if (best_count == piece.rays.size()) break;
    }
    return best;
  }

  // A point of a flat cell that a triangle of another plane holds may see p without the points beside it
  // (D6).
  bool stands_at(const TriangleCorners& t, const Point3& v) const {
    return !solid_ && blocks(t, v, true, p_) &&
           !std::all_of(t.begin(), t.end(), [&](const Point3& corner) { return plane_.has_on(corner); });
  }

  Point3 entry(const Vector3& direction) const { return reach(direction, plane_); }

  Point3 reach(const Vector3& direction, const Plane3& plane) const {
    const Vector3 normal = plane.orthogonal_vector();
    const FT at_p = CGAL::scalar_product(normal, p_ - CGAL::ORIGIN) + plane.d();
    return p_ - direction * (at_p / CGAL::scalar_product(normal, direction));
  }

  // The middle of the ray's part in V; for a flat cell the point where the ray meets it.
  Point3 beyond(const Vector3& direction) const {
    const Point3 in = entry(direction);
    if (!solid_) return in;
    std::optional<Point3> out;
    for (const CellFacet& facet : cell_.facets()) {
      if (CGAL::sign(CGAL::scalar_product(facet.plane.orthogonal_vector(), direction)) != CGAL::POSITIVE) continue;
      const Point3 x = reach(direction, facet.plane);
      if (!out || CGAL::scalar_product(x - *out, direction) < 0) out = x;
    }
    return CGAL::midpoint(in, *out);
  }

  const Point3& p_;
  const ConvexCell& cell_;
  const std::vector<TriangleCorners>& triangles_;
  bool
      solid_;  // of dimension 3: V's surface is outside int V, so triangles on it block. On a flat cell they stop no line from it
  Plane3 plane_;
  std::vector<std::optional<std::optional<DirectionCone>>> shadows_;  // per triangle, when asked for
};

std::optional<Point3> free_point(const Point3& p, const std::optional<Plane3>& side, const ConvexCell& cell,
                                 const std::vector<TriangleCorners>& triangles) {
  const auto& vertices = cell.vertices();
  if (cell.dimension() == 0) {
    const Point3& v = cell.center();
    const bool free =
        allowed(side, v) && std::none_of(triangles.begin(), triangles.end(),
                                         [&](const TriangleCorners& t) { return blocks(t, v, false, p); });
    return free ? std::optional<Point3>(v) : std::nullopt;
  }
  if (cell.dimension() == 1) {
    if (!CGAL::collinear(vertices[0], vertices[1], p))
      return free_point_of_segment(p, side, vertices[0], vertices[1], triangles);
    if (!allowed(side, cell.center())) return std::nullopt;  // then no point of the line beyond p is
    return free_point_of_segment_end_on(p, vertices[0], vertices[1], triangles);
  }

  ConeSearch cones(p, cell, triangles);
  if (cell.dimension() == 2) {
    const CellFacet& facet = cell.facets()[0];
    if (facet.plane.has_on(p)) return free_point_of_polygon(p, side, corners_of(cell, facet), triangles);
    const bool front = facet.plane.has_on_positive_side(p);
    return cones.search(front ? facet.plane : facet.plane.opposite(), corners_of(cell, facet), side);
  }
  for (const CellFacet& facet : cell.facets()) {
    if (!facet.plane.has_on_positive_side(p)) continue;
    if (auto v = cones.search(facet.plane, corners_of(cell, facet), side)) return v;
  }
  return std::nullopt;
}

}  // namespace

OcclusionAnswer point_occlusion(const Point3& p, const std::optional<Plane3>& side, const ConvexCell& cell,
                                const std::vector<TriangleCorners>& triangles) {
  if (side && !side->has_on(p)) {
    throw scene::Error(scene::ErrorCode::bad_argument, "point_occlusion: p must lie in the plane of its side");
  }
  if (cell.contains(p)) {
    if (cell.dimension() < 3) return {false, std::nullopt};  // what stands in V may be between p and the rest of V
    return {false, interior_point_on_side(cell, side)};
  }
  std::optional<Point3> v = free_point(p, side, cell, triangles);
  if (!v) return {true, std::nullopt};
  *v = collapsed(*v);
  if (!cell.interior_contains(*v) || !allowed(side, *v)) {
    throw scene::Error(scene::ErrorCode::internal, "point_occlusion: the sight line found does not start in the cell");
  }
  return {false, v};
}

}  // namespace clues::exact
