// From bytes to a verdict: a small scene and its map (D15), which independent exact means then look at. Omega contains all that is visible (T1): what the map
// calls hidden, neither the point-occlusion oracle nor any sight line may see; and the fast path must agree with exact arithmetic about each line, and lose no triangle.
#include <algorithm>
#include <array>

#include "exact/sight/point_occlusion.h"
#include "exact/sight/scene_query.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/first_order.h"
#include "fuzz/targets/scene_bytes.h"
#include "fuzz/targets/targets.h"
#include "reference/visibility/first_order.h"

namespace clues::fuzz {
namespace {

using exact::Point3;

void require(bool kept, const char* promise) {
  if (!kept) throw BrokenPromise(promise);
}

scene::Point between(const scene::Point& a, const scene::Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

// Hidden regions against the whole cell. Whether there was one.
bool hidden_regions_are_hidden(const reference::VisibilityMap& map) {
  std::vector<exact::TriangleCorners> soup;
  const auto& points = map.complex.points;
  for (const auto& p : map.complex.pieces)
    soup.push_back({points[p.corners[0]], points[p.corners[1]], points[p.corners[2]]});
  bool any = false;
  for (const auto& r : map.regions) {
    if (r.visible) continue;
    any = true;
    const auto& plane = map.complex.planes[r.piece];
    const auto seen = exact::point_occlusion(r.sample, r.front ? plane : plane.opposite(), map.cell, soup);
    require(seen.occluded || !seen.witness, "what the map calls hidden is hidden");
  }
  return any;
}

// The default limits of D17 allow a scene of bytes whose coordinates are 1000 bits long minutes of work under sanitizers.
template <class Options>
void limit(Options& options) {
  options.dials.generation_limit = 4;
  options.dials.csv_limit = 64;
}

void fast_path_loses_nothing(const Case& scene, const reference::VisibilityMap& map) {
  if (map.statistics.conservative_fallbacks > 0) return;
  fastpath::LocalMapOptions options;
  limit(options);
  const auto fast = fastpath::first_order_visibility(fastpath::Bvh(scene.mesh), scene.cell, options).visible;
  require(std::includes(fast.begin(), fast.end(), map.visible.begin(), map.visible.end()),
          "what the reference calls visible is visible to the fast path");
}

// From points of the cell to corners, edges and the inside of every triangle.
void sight_lines_agree(const Case& scene, const reference::VisibilityMap& map) {
  std::vector<scene::Point> views;
  for (std::size_t i = 0; i < scene.cell.size() && views.size() < 3; ++i) {
    const auto v = between(scene.cell[i], between(scene.cell.front(), scene.cell.back(), 0.5), 0.375);
    if (map.cell.interior_contains(exact::to_exact(v))) views.push_back(v);
  }
  const fastpath::Bvh bvh(scene.mesh);
  const fastpath::Cell cell(scene.cell);
  fastpath::SegmentQueries fast(bvh);
  const exact::SceneQuery exactly(map.complex, map.cell);
  for (const auto& t : scene.mesh.triangles) {
    const auto &a = scene.mesh.points[t[0]], &b = scene.mesh.points[t[1]], &c = scene.mesh.points[t[2]];
    for (const auto& p : {a, between(a, b, 0.5), between(c, between(a, b, 0.25), 0.75)}) {
      for (const auto& v : views) {
        const bool free = exactly.is_free(exact::to_exact(v), exact::to_exact(p));
        require(free != fast.any_hit({v, p}, {{}, &cell}),
                "the fast path decides a sight line as exact arithmetic does");
      }
    }
  }
}

}  // namespace

bool scene_to_verdict(std::string_view bytes) {
  const Case scene = scene_of_bytes(bytes);
  reference::Options options;
  options.threads = 1;
  limit(options);
  const auto map = reference::first_order_visibility(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
  require(map.statistics.walk_disagreements == 0, "a label does not depend on where the walk starts (D14)");
  sight_lines_agree(scene, map);
  fast_path_loses_nothing(scene, map);
  return hidden_regions_are_hidden(map);
}

}  // namespace clues::fuzz
