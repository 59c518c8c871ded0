#include "reference/visibility/backprojection.h"

#include <algorithm>
#include <utility>

#include "exact/cell_cut.h"
#include "reference/visibility/exactness.h"

namespace clues::reference {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;

namespace {

// The edge of the complex with the wedge's near segment.
std::optional<std::uint32_t> edge_of(const exact::Complex& complex, const Wedge& w) {
  const auto id = [&](const Point3& p) { return std::find(complex.points.begin(), complex.points.end(), p); };
  const auto a = id(w.near0), b = id(w.near1);
  if (a == complex.points.end() || b == complex.points.end()) return std::nullopt;
  const auto lo = static_cast<std::uint32_t>(std::min(a, b) - complex.points.begin());
  const auto hi = static_cast<std::uint32_t>(std::max(a, b) - complex.points.begin());
  for (const std::uint32_t e : complex.point_edges[lo]) {
    if (complex.edges[e].a == lo && complex.edges[e].b == hi) return e;
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
    if (!joined.empty() && joined.back().edge == s.edge && joined.back().center == s.center && s.lo <= joined.back().hi) {
      joined.back().hi = std::max(joined.back().hi, s.hi);
    } else {
      joined.push_back(s);
    }
  }
  segments = std::move(joined);
}

struct Part {
  ConvexCell cell;
  VisibilityMap map;
  SideSets seen;  // a bound of what the part sees, on the sides that were open when it was made
};

bool sees_more(const SideSets& seen, const Bounds& bounds, const std::vector<bool>& open) {
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] && !subtract(seen[i], bounds.lower()[i]).empty()) return true;
  }
  return false;
}

SideSets common(const SideSets& a, const SideSets& b, const std::vector<bool>& open) {
  SideSets out = a;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (open[i]) out[i] = intersect(a[i], b[i]);
  }
  return out;
}

void look_from(const ConvexCell& cell, Bounds& bounds) {
  for (const Point3& v : cell.vertices()) bounds.add_viewpoint(v);
  bounds.add_viewpoint(cell.center());
}

class Refiner {
 public:
  Refiner(Bounds& bounds, const RefineOptions& options) : bounds_(bounds), options_(options) {}

  std::vector<DepthFigures> run(const DepthReport& report) {
    std::vector<DepthFigures> depths;
    const auto note = [&](int depth, std::size_t cells) {
      depths.push_back({depth, cells, bounds_.maps(), bounds_.viewpoints(), bounds_.area()});
      if (report) report(depths.back());
    };
    std::vector<Part> parts;
    parts.push_back({bounds_.first_order().cell, bounds_.first_order(), bounds_.upper()});
    look_from(parts[0].cell, bounds_);
    note(0, 1);
    for (int depth = 1; depth <= options_.max_depth; ++depth) {
      open_ = bounds_.open_sides();
      if (std::none_of(open_.begin(), open_.end(), [](bool o) { return o; })) break;
      if (depths.back().area.excess() <= options_.tolerance_area) break;
      std::vector<Part> next;
      for (Part& part : parts) cut(std::move(part), next);
      parts = std::move(next);
      SideSets all = parts[0].seen;
      for (std::size_t i = 1; i < parts.size(); ++i) all = unite(all, parts[i].seen);
      bounds_.restrict_to(all, open_);
      for (const Part& part : parts) look_from(part.cell, bounds_);
      note(depth, parts.size());
    }
    return depths;
  }

 private:
  Part part_of(ConvexCell cell) {
    VisibilityMap map = bounds_.map_of(cell, open_);
    SideSets seen = bounds_.sets_of(map);
    return {std::move(cell), std::move(map), std::move(seen)};
  }

  void cut(Part part, std::vector<Part>& out) {
    if (!sees_more(part.seen, bounds_, open_)) {
      out.push_back(std::move(part));
      return;
    }
    std::vector<Part> best;
    double best_area = bounds_.area_estimate(part.seen);
    for (const ContourSegment& s : inexact_segments(part.map, open_)) {
      const Plane3 plane =
          adjusted_plane(s, seen_by_segment(part.map.complex, s, part.cell, bounds_.options()), part.cell);
      const auto plus = exact::part_beside(part.cell, plane, exact::Side::negative);
      const auto minus = exact::part_beside(part.cell, plane, exact::Side::positive);
      if (!plus || !minus) continue;
      std::vector<Part> halves;
      halves.push_back(part_of(*plus));
      halves.push_back(part_of(*minus));
      const SideSets both = unite(halves[0].seen, halves[1].seen);
      const double area = bounds_.area_estimate(common(bounds_.upper(), both, open_));
      part.seen = common(part.seen, both, open_);
      if (area < best_area) {
        best_area = area;
        best = std::move(halves);
      }
    }
    if (best.empty()) {
      const std::vector<ConvexCell> cells = halves(part.cell);
      if (cells.size() < 2) {
        out.push_back(std::move(part));
        return;
      }
      for (const ConvexCell& cell : cells) best.push_back(part_of(cell));
    }
    for (Part& half : best) {
      half.seen = common(half.seen, part.seen, open_);
      out.push_back(std::move(half));
    }
  }

  Bounds& bounds_;
  RefineOptions options_;
  std::vector<bool> open_;
};

}  // namespace

std::vector<ContourSegment> inexact_segments(const VisibilityMap& map, const std::vector<bool>& open) {
  const exact::SceneQuery scene(map.complex, map.cell);
  std::vector<ContourSegment> segments;
  for (const Wedge& w : map.wedges) {
    if (w.kind == WedgeKind::se_mv || w.unbounded) continue;
    const bool front = map.complex.planes[w.blocker].oriented_side(w.center) == CGAL::ON_POSITIVE_SIDE;
    if (!open[side_index(w.blocker, front)]) continue;
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
  const auto& own = complex.edges[segment.edge].pieces;
  for (std::uint32_t t = 0; t < complex.pieces.size(); ++t) {
    if (complex.in_cell[t] || std::find(own.begin(), own.end(), t) != own.end()) continue;
    triangles.push_back(complex.pieces[t].corners);
  }
  const std::size_t receivers = triangles.size();
  std::vector<Point3> points = complex.points;
  const auto base = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), cell.vertices().begin(), cell.vertices().end());
  for (const exact::CellFacet& f : cell.facets()) {
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
  const VisibilityMap map = first_order_visibility_in(
      scene, ConvexCell(std::vector<Point3>{segment.lo, segment.hi}), options, wanted);
  std::vector<Point3> seen;
  for (const Region& r : map.regions) {
    if (r.visible) seen.insert(seen.end(), r.rings[0].begin(), r.rings[0].end());
  }
  return seen;
}

Plane3 adjusted_plane(const ContourSegment& segment, const std::vector<Point3>& seen, const ConvexCell& cell) {
  const Point3 &a = segment.lo, &b = segment.hi;
  // Seen along the line of the segment, V fills an angle of at most a half turn, from the wedge's plane on; first: what it meets first.
  const CGAL::Orientation turn = CGAL::orientation(a, b, segment.center, cell.center());
  const auto ahead = [&](const Point3& x, const Point3& y) { return CGAL::orientation(a, b, x, y) == turn; };
  std::optional<Point3> first;
  for (const Point3& q : seen) {
    if (!CGAL::collinear(a, b, q) && (!first || ahead(q, *first))) first = q;
  }
  const Point3 touched = first ? *first : cell.center();
  const Plane3 plane(a, b, touched);
  // V(s) lies ahead of `touched`, on the side of the plane that `turn` tells.
  return turn == CGAL::POSITIVE ? plane.opposite() : plane;
}

std::vector<DepthFigures> refine_by_backprojection(Bounds& bounds, const RefineOptions& options,
                                                   const DepthReport& report) {
  return Refiner(bounds, options).run(report);
}

}  // namespace clues::reference
