#include "reference/visibility/first_order.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "exact/scene_query.h"
#include "reference/visibility/fixpoint.h"
#include "reference/visibility/regions.h"
#include "reference/visibility/traversal/traversal.h"
#include "scene/error.h"

namespace clues::reference {

namespace {

void require_solid(const exact::Complex& complex) {
  const std::vector<std::uint32_t> bad = exact::triangles_not_solid(complex);
  if (bad.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < bad.size() && i < 5; ++i) list += (i ? ", " : "") + std::to_string(bad[i]);
  throw scene::Error(scene::ErrorCode::not_solid,
                     "solid mode needs a closed, consistently oriented mesh, but triangle" +
                         std::string(bad.size() > 1 ? "s " : " ") + list + (bad.size() > 5 ? ", ..." : "") + " (" +
                         std::to_string(bad.size()) +
                         " in all) have an edge that is open or turned over; close the mesh, or use sheet mode");
}

bool counts(Mode mode, const exact::Origin& o, bool front) { return mode == Mode::sheet || o.same_side == front; }

}  // namespace

VisibilityMap first_order_visibility(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                     const Options& options) {
  VisibilityMap map{exact::build_complex(mesh, &cell), cell, options.mode, options.formulation, {}, {}, {}, {}, {}};
  if (options.mode == Mode::solid) require_solid(map.complex);
  if (options.progress) options.progress("refine", map.complex.pieces.size(), map.complex.pieces.size());
  map.statistics.refined_triangles = map.complex.refined_triangles;

  const exact::SceneQuery scene(map.complex, map.cell);
  const auto finish = [&](const exact::SceneQuery& in, const Fixpoint& fixpoint, const std::vector<bool>& visited) {
    for (const ValidPiece& p : fixpoint.wedges.pieces()) map.wedges.push_back(p.wedge);
    make_regions(in, fixpoint, visited, options, map);
  };
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    if (options.formulation == Formulation::traversal) {
      const Traversal t = traverse(scene, options, map.statistics);
      finish(*t.scene, t.fixpoint, t.visited);
    } else {
      finish(scene, find_wedges(scene, options, map.statistics), {});
    }
  });
  assert(options.planted_bug != PlantedBug::none || map.statistics.walk_disagreements == 0);  // D14

  // D15: the PVS. D3: a triangle that meets the cell is visible.
  std::vector<bool> visible(mesh.triangles.size(), false);
  for (const Region& r : map.regions) {
    if (!r.visible) continue;
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      if (counts(map.mode, o, r.front)) visible[o.triangle] = true;
    }
  }
  for (std::uint32_t t = 0; t < map.complex.pieces.size(); ++t) {
    if (!scene.meets_cell(t)) continue;
    for (const exact::Origin& o : map.complex.pieces[t].origins) visible[o.triangle] = true;
  }
  for (std::uint32_t t = 0; t < visible.size(); ++t) {
    if (visible[t]) map.visible.push_back(t);
  }
  return map;
}

std::vector<std::uint8_t> VisibilityMap::triangle_state() const {
  std::vector<std::uint8_t> state(complex.input_triangles, 0);
  for (const Region& r : regions) {
    for (const exact::Origin& o : complex.pieces[r.piece].origins) {
      if (counts(mode, o, r.front))
        state[o.triangle] = static_cast<std::uint8_t>(state[o.triangle] | (r.visible ? 1U : 2U));
    }
  }
  for (const std::uint32_t t : visible) state[t] = static_cast<std::uint8_t>(state[t] | 1U);
  return state;
}

scene::Result to_result(const VisibilityMap& map, const scene::CellSpec& cell, bool with_map) {
  scene::Result result;
  result.scene_triangles = map.complex.input_triangles;
  result.cell = cell.points;
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
  const auto text = [](const exact::Point3& p) {
    return std::array<std::string, 3>{exact::to_string_exact(p.x()), exact::to_string_exact(p.y()),
                                      exact::to_string_exact(p.z())};
  };
  for (const Region& r : map.regions) {
    scene::MapRegion out;
    out.visible = r.visible;
    for (const auto& ring : r.rings) {
      out.rings_exact.emplace_back();
      out.rings.emplace_back();
      for (const exact::Point3& p : ring) {
        out.rings_exact.back().push_back(text(p));
        out.rings.back().push_back(exact::to_double_estimate(p));
      }
    }
    out.area_fraction = exact::to_string_exact(r.area_fraction);
    for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
      out.triangle = o.triangle;
      out.front = o.same_side == r.front;
      if (counts(map.mode, o, r.front)) result.regions.push_back(out);
    }
  }
  for (const DmSegment& d : map.segments) {
    for (const exact::Origin& o : map.complex.pieces[d.piece].origins) {
      if (!counts(map.mode, o, d.front)) continue;
      result.segments.push_back({o.triangle,
                                 o.same_side == d.front,
                                 d.boundary,
                                 {text(d.a), text(d.b)},
                                 {exact::to_double_estimate(d.a), exact::to_double_estimate(d.b)}});
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
      out.points[i] = exact::to_double_estimate(p[i]);
    }
    result.wedges.push_back(std::move(out));
  }
  return result;
}

}  // namespace clues::reference
