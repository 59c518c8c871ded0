#include "reference/visibility/first_order.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "exact/sight/scene_query.h"
#include "exact/threads.h"
#include "reference/visibility/hidden/render_states.h"
#include "reference/visibility/map/discontinuity_mesh.h"
#include "reference/visibility/map/in_doubt.h"
#include "reference/visibility/map/omega.h"
#include "reference/visibility/map/regions.h"
#include "reference/visibility/map/sides.h"
#include "reference/visibility/search/fixpoint.h"
#include "reference/visibility/traversal/traversal.h"

namespace clues::reference {

namespace {

int threads_of(const Options& options) { return options.dials.threads > 0 ? options.dials.threads : options.threads; }

exact::Complex complex_for(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options,
                           const exact::StandardRange& range) {
  exact::Complex complex = exact::by_threads(threads_of(options), [&] {
    if (!range.moves()) return exact::build_complex(mesh, &cell);
    const exact::ConvexCell moved = range.moved_in(cell);
    return exact::build_complex(range.moved_in(mesh), &moved);
  });
  if (options.mode == Mode::solid) exact::require_solid(complex);
  return complex;
}

}  // namespace

Omega::Omega(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options)
    : Omega(mesh, cell, options, exact::StandardRange(mesh, cell)) {}

Omega::Omega(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell, const Options& options,
             const exact::StandardRange& range)
    : Omega(complex_for(mesh, cell, options, range), range.moved_in(cell), options, {}) {
  map_->range = range;
  exact::by_threads(threads_of(options), [&] { map_->in_doubt = find_in_doubt(*scene_, *fixpoint_, options, *map_); });
  fixpoint_->find_known = nullptr;
}

Omega::Omega(exact::Complex complex, const exact::ConvexCell& cell, const Options& options,
             const std::vector<bool>& wanted) {
  map_.reset(new VisibilityMap{std::move(complex), cell, options.mode, options.formulation, {}, {}, {}, {}, {}});
  VisibilityMap& map = *map_;
  if (options.progress) options.progress("refine", map.complex.pieces.size(), map.complex.pieces.size());
  map.statistics.refined_triangles = map.complex.refined_triangles;

  scene_ = std::make_unique<exact::SceneQuery>(map.complex, map.cell);
  exact::by_threads(threads_of(options), [&] {
    std::vector<bool> visited;
    if (options.formulation == Formulation::traversal) {
      Traversal t = traverse(*scene_, options, map.statistics);
      part_ = std::move(t.part);
      scene_ = std::move(t.scene);
      fixpoint_ = std::make_unique<Fixpoint>(std::move(t.fixpoint));
      visited = std::move(t.visited);
    } else {
      fixpoint_ = std::make_unique<Fixpoint>(find_wedges(*scene_, options, map.statistics));
    }
    for (const ValidPiece& p : fixpoint_->wedges.pieces()) map.wedges.push_back(p.wedge);
    make_regions(*scene_, *fixpoint_, {visited, wanted}, options, map);
  });
  assert(map.statistics.walk_disagreements == 0);  // D14
  find_visible(*scene_, map);
}

VisibilityMap first_order_visibility(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     const Options& options) {
  return moved_back(Omega(mesh, cell, options).take_map());
}

VisibilityMap moved_back(VisibilityMap map) {
  const exact::StandardRange range = std::exchange(map.range, {});
  if (!range.moves()) return map;
  const auto move = [&](exact::Point3& p) { p = range.moved_back(p); };
  std::for_each(map.complex.points.begin(), map.complex.points.end(), move);
  for (exact::Plane3& h : map.complex.planes) h = range.moved_back(h);
  map.complex.unit = exact::unit_of(map.complex.points);
  map.cell = range.moved_back(map.cell);
  for (Wedge& w : map.wedges) {
    w.plane = range.moved_back(w.plane);
    for (exact::Point3* p : {&w.center, &w.near0, &w.near1, &w.on_ray0, &w.on_ray1}) move(*p);
    if (w.unbounded) continue;
    move(w.far0);
    move(w.far1);
  }
  for (DmSegment& d : map.segments) {
    move(d.a);
    move(d.b);
  }
  for (Region& r : map.regions) {
    for (auto& ring : r.rings) std::for_each(ring.begin(), ring.end(), move);
    move(r.sample);
  }
  return map;
}

VisibilityMap first_order_visibility_in(const exact::Complex& complex, const exact::ConvexCell& cell,
                                        const Options& options, const std::vector<bool>& wanted) {
  return Omega(complex, cell, options, wanted).take_map();
}

scene::Result to_result(const VisibilityMap& map, const scene::CellSpec& cell, bool with_map, bool with_render_states) {
  scene::Result result;
  result.scene_triangles = map.complex.input_triangles;
  result.cell = cell.points;
  result.method = map.method;
  result.mode = map.mode == Mode::solid ? "solid" : "sheet";
  result.visible = map.visible;
  const Statistics& s = map.statistics;
  const auto put = [&](const char* name, std::uint64_t value) {
    result.stats[name] = static_cast<std::int64_t>(value);
  };
  put("conservative_fallbacks", s.conservative_fallbacks);
  put("csv", s.csv);
  put("degenerate_triangles", map.complex.degenerate.size());
  put("generations", static_cast<std::uint64_t>(s.generations));
  if (map.method == "first-order") put("in_doubt", map.in_doubt.size());
  put("inside_corners", s.inside_corners);
  put("parallel_edges", s.parallel_edges);
  put("refined_triangles", s.refined_triangles);
  put("regions_hidden", s.regions_hidden);
  put("regions_visible", s.regions_visible);
  put("rounds", s.rounds);
  put("se_me", s.se_me);
  put("se_mv", s.se_mv);
  put("sv_me", s.sv_me);
  put("walk_disagreements", s.walk_disagreements);
  put("walks", s.walks);
  if (map.formulation == Formulation::traversal) {
    put("traversal_by_order", s.by_order);
    put("traversal_cycles", s.cycles);
    put("traversal_clusters", s.clusters);
    put("traversal_passes", s.passes);
    put("traversal_shaft_tests", s.shaft_tests);
    put("traversal_sight_lines", s.sight_lines);
    put("traversal_surfaces_seen", s.surfaces_seen);
    put("traversal_surfaces_visited", s.surfaces_visited);
    put("traversal_wedges_built", s.wedges_built);
  }
  if (!with_map) return result;

  result.has_map = true;
  const auto text = [&](const exact::Point3& in_range) {
    const exact::Point3 p = map.range.moved_back(in_range);
    return std::array<std::string, 3>{exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                                      exact::to_string_exact(p.z())};
  };
  const auto estimate = [&](const exact::Point3& p) {
    return map.range.estimate_moved_back(exact::to_double_estimate(p));
  };
  std::vector<RenderState> states;
  if (with_render_states) states = render_states(map);
  result.has_render_states = with_render_states;
  std::vector<std::vector<std::uint64_t>> places;  // per region of the map: its places in the result
  for (const Region& r : map.regions) {
    scene::MapRegion out;
    out.visible = r.visible;
    if (with_render_states) out.render_states = names_of(states[places.size()]);
    places.emplace_back();
    for (const auto& ring : r.rings) {
      out.rings_exact.emplace_back();
      out.rings.emplace_back();
      for (const exact::Point3& p : ring) {
        out.rings_exact.back().push_back(text(p));
        out.rings.back().push_back(estimate(p));
      }
    }
    out.area_fraction = exact::to_string_exact(r.area_fraction);
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      out.triangle = o.triangle;
      out.front = o.same_side == r.front;
      if (!counts(map.mode, o, r.front)) continue;
      places.back().push_back(result.regions.size());
      result.regions.push_back(out);
    }
  }
  const DiscontinuityMesh mesh = discontinuity_mesh(map);
  for (const exact::Point3& p : mesh.vertices) result.mesh.vertices_exact.push_back(text(p));
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) result.mesh.faces.push_back({places[i], mesh.faces[i]});
  for (const DiscontinuityMesh::Edge& e : mesh.edges) {
    scene::MapMesh::Edge out{e.right ? e.boundary ? "ob" : "dm" : "border", {e.a, e.b}, {e.left}};
    if (e.right) out.faces.push_back(*e.right);
    result.mesh.edges.push_back(std::move(out));
  }
  for (const DmSegment& d : map.segments) {
    for (const exact::Origin& o : map.complex.pieces[d.piece].origins) {
      if (!counts(map.mode, o, d.front)) continue;
      result.segments.push_back(
          {o.triangle, o.same_side == d.front, d.boundary, {text(d.a), text(d.b)}, {estimate(d.a), estimate(d.b)}});
    }
  }
  for (const Wedge& w : map.wedges) {
    scene::MapWedge out;
    out.kind = w.kind == WedgeKind::sv_me ? "SV-ME" : w.kind == WedgeKind::se_me ? "SE-ME" : "SE-MV";
    out.generation = w.generation;
    out.unbounded = w.unbounded;
    const std::array<exact::Point3, 4> p{w.near0, w.near1, w.unbounded ? w.near0 + (w.on_ray0 - w.center) : w.far0,
                                         w.unbounded ? w.near1 + (w.on_ray1 - w.center) : w.far1};
    for (std::size_t i = 0; i < 4; ++i) {
      out.exact[i] = text(p[i]);
      out.points[i] = estimate(p[i]);
    }
    result.wedges.push_back(std::move(out));
  }
  return result;
}

}  // namespace clues::reference
