#include "reference/visibility/refinement/backprojection.h"

#include <algorithm>
#include <utility>

#include "reference/visibility/refinement/exactness.h"
#include "reference/visibility/wedges/contour.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;

namespace {

// The edge of the complex that the wedge's near segment is a part of.
std::optional<std::uint32_t> edge_of(const exact::Complex& complex, const Wedge& w) {
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const exact::Kernel::Segment_3 edge(complex.points[complex.edges[e].a], complex.points[complex.edges[e].b]);
    if (edge.has_on(w.near0) && edge.has_on(w.near1)) return e;
  }
  return std::nullopt;
}

// Joins parts of one edge and plane that touch or overlap.
void join(std::vector<ContourSegment>& segments) {
  for (ContourSegment& s : segments) {
    if (s.hi < s.lo) std::swap(s.lo, s.hi);
  }
  std::stable_sort(segments.begin(), segments.end(), [](const ContourSegment& x, const ContourSegment& y) {
    if (x.edge != y.edge) return x.edge < y.edge;
    if (x.center != y.center) return x.center < y.center;
    return x.lo < y.lo;
  });
  std::vector<ContourSegment> joined;
  for (const ContourSegment& s : segments) {
    if (!joined.empty() && joined.back().edge == s.edge && joined.back().center == s.center &&
        s.lo <= joined.back().hi) {
      joined.back().hi = std::max(joined.back().hi, s.hi);
    } else {
      joined.push_back(s);
    }
  }
  segments = std::move(joined);
}

}  // namespace

std::vector<ContourSegment> inexact_segments(const VisibilityMap& map, const std::vector<bool>& open) {
  const exact::SceneQuery scene(map.complex, map.cell);
  // The adjusted wedge runs in H-: what it could hide is there, whatever the wedge itself ends on.
  const auto reaches_open_side = [&](const Wedge& w) {
    for (std::uint32_t t = 0; t < map.complex.pieces.size(); ++t) {
      if (!open[side_index(t, true)] && !open[side_index(t, false)]) continue;
      for (const std::uint32_t c : map.complex.pieces[t].corners) {
        if (w.plane.oriented_side(map.complex.points[c]) == CGAL::ON_POSITIVE_SIDE) return true;
      }
    }
    return false;
  };
  std::vector<ContourSegment> segments;
  for (const Wedge& w : map.wedges) {
    if (w.kind == WedgeKind::se_mv || !reaches_open_side(w)) continue;
    const auto edge = edge_of(map.complex, w);
    if (!edge) continue;
    // The plane may touch V in several vertices, each with a wedge: one of them stands for the plane.
    const auto touched = std::find_if(map.cell.vertices().begin(), map.cell.vertices().end(), [&](const Point3& s) {
      return w.plane.has_on(s) && !CGAL::collinear(w.near0, w.near1, s);
    });
    for (const Portion& portion : portions(scene, w)) {
      if (!portion.exact) segments.push_back({*edge, portion.lo, portion.hi, w.plane, *touched});
    }
  }
  join(segments);
  return segments;
}

std::vector<Point3> seen_by_segment(const exact::Complex& complex, const ContourSegment& segment,
                                    const ConvexCell& cell, const Options& options) {
  if (cell.dimension() < 2) return cell.vertices();
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Point3> ends = cell.vertices();
  ends.insert(ends.end(), {segment.lo, segment.hi});
  const ConvexCell between(ends);
  // What lies in a plane through the segment is edge-on: it neither hides anything nor is seen.
  const auto edge_on = [&](const Plane3& plane) { return plane.has_on(segment.lo) && plane.has_on(segment.hi); };
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (complex.in_cell[t] || edge_on(complex.planes[t])) continue;
    const auto& c = complex.pieces[t].corners;
    if (exact::meets_cell({complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]}, between))
      triangles.push_back(c);
  }
  const std::size_t receivers = triangles.size();
  std::vector<Point3> points = complex.points;
  const auto base = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), cell.vertices().begin(), cell.vertices().end());
  for (const exact::CellFacet& f : cell.facets()) {
    if (edge_on(f.plane)) continue;
    const auto corner = [&](std::size_t i) { return base + static_cast<std::uint32_t>(f.corners[i]); };
    for (std::size_t i = 2; i < f.corners.size(); ++i) triangles.push_back({corner(0), corner(i - 1), corner(i)});
  }
  const exact::Complex scene = exact::build_complex(points, triangles);
  std::vector<bool> wanted(2 * scene.pieces.size(), false);
  for (std::uint32_t t = 0; t < scene.pieces.size(); ++t) {
    for (const exact::Origin& o : scene.pieces[t].origins) {
      if (o.triangle < receivers) continue;
      wanted[side_index(t, o.same_side)] = true;
      if (cell.dimension() == 2) wanted[side_index(t, !o.same_side)] = true;
    }
  }
  const ConvexCell source(std::vector<Point3>{segment.lo, segment.hi});
  std::vector<Point3> seen;
  try {
    for (const Region& r : first_order_visibility_in(scene, source, options, wanted).regions) {
      if (r.visible) seen.insert(seen.end(), r.rings[0].begin(), r.rings[0].end());
    }
  } catch (const scene::Error& e) {
    // A lineal source among the scene's own edges may have no sight line in general position: then all of V counts as seen.
    if (e.code() != scene::ErrorCode::internal) throw;
    return cell.vertices();
  }
  return seen;
}

std::optional<Plane3> adjusted_plane(const ContourSegment& segment, const std::vector<Point3>& seen,
                                     const ConvexCell& cell) {
  const Point3 &a = segment.lo, &b = segment.hi;
  // Seen along the line of the segment, V fills an angle of at most a half turn, from the wedge's plane on; first: what it meets first.
  const CGAL::Orientation turn = CGAL::orientation(a, b, segment.center, cell.center());
  const auto first = last_about(a, b, seen, CGAL::opposite(turn));
  if (!first) return std::nullopt;
  const Plane3 plane(a, b, seen[*first]);
  // V(s) lies ahead of `first`, on the side of the plane that `turn` tells.
  return turn == CGAL::POSITIVE ? plane.opposite() : plane;
}

}  // namespace clues::reference
