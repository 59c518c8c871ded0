#include "fastpath/visibility/first_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "exact/complex/complex.h"
#include "exact/complex/cut_memory.h"
#include "exact/threads.h"

namespace clues::fastpath {
namespace {

class EnginePart : public PartialMap {
 public:
  explicit EnginePart(LocalMap map) : map_(std::move(map)) {}

  // What light meets, on either side: the closure asks for that in solid mode too.
  std::vector<std::uint32_t> visible() const override { return map_.lit(); }
  SetLabel label(const Box& box) const override { return map_.label(box); }
  SetLabel label_of_inside(const Corners& triangle, const Box& about) const override {
    return map_.label_of_inside(triangle, about);
  }

  const LocalMap& map() const { return map_; }

 private:
  LocalMap map_;
};

// The box of the scene, widened by far more than what boxes and points of the closure may be off.
Box outside_of(const Bvh& bvh) {
  const LocalFrame& frame = bvh.frame();
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = frame.center[i] - 2 / frame.scale;
    box.high[i] = frame.center[i] + 2 / frame.scale;
  }
  return box;
}

FirstOrder by_closure(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options, bool regions) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  const Box outside = outside_of(bvh);
  exact::CutMemory memory;
  const auto make_map = [&](const scene::TriangleMesh& part, const std::vector<std::uint32_t>& ids) {
    return std::make_shared<const EnginePart>(make_local_map({part, ids, memory}, exact_cell, options, &outside));
  };
  Closure closure = close_over_visible(bvh, Cell(exact_cell), make_map, kMappedWhole, options.dials);
  const LocalMap& map = static_cast<const EnginePart&>(*closure.map).map();

  FirstOrder result;
  for (const std::uint32_t t : map.visible()) result.visible.push_back(closure.part[t]);
  if (regions) result.regions = map.regions();
  for (LocalRegion& region : result.regions) region.triangle = closure.part[region.triangle];
  result.counts = map.counts();
  result.closure = closure.counts;
  result.conservative_fallbacks = map.counts().conservative_fallbacks + map.conservative_labels();
  result.part = std::move(closure.part);
  return result;
}

}  // namespace

FirstOrder first_order_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                  bool regions) {
  return exact::by_dialed_threads(options.dials.threads, [&] {
    const exact::StandardRange range(bvh.mesh(), cell);
    if (!range.moves()) return by_closure(bvh, cell, options, regions);
    const scene::TriangleMesh mesh = range.moved_in(bvh.mesh());
    FirstOrder result = by_closure(Bvh(mesh), range.moved_in(cell), options, regions);
    move_back(result.regions, range);
    return result;
  });
}

void move_back(std::vector<LocalRegion>& regions, const exact::StandardRange& range) {
  for (LocalRegion& region : regions) {
    for (Point& p : region.outline_estimate) p = range.estimate_moved_back(p);
    region.area_estimate = range.area_moved_back(region.area_estimate);
  }
}

void require_solid(const scene::TriangleMesh& mesh) {
  // Every edge is gone through as often in one direction as in the other; corners are the same where their coordinates are. Cutting triangles where they
  // meet keeps that, so the exact test is for meshes with T-junctions only.
  std::vector<std::uint32_t> order(mesh.points.size()), corner(mesh.points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto& points = mesh.points;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return points[a] < points[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    corner[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? corner[order[i - 1]] : order[i];
  }
  struct Way {
    std::uint32_t low, high;
    int balance;
  };
  std::vector<Way> ways;
  const auto degenerate = scene::degenerate_triangles(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(degenerate.begin(), degenerate.end(), t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[mesh.triangles[t][k]], b = corner[mesh.triangles[t][(k + 1) % 3]];
      ways.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  std::sort(ways.begin(), ways.end(),
            [](const Way& x, const Way& y) { return std::tie(x.low, x.high) < std::tie(y.low, y.high); });
  for (std::size_t i = 0; i < ways.size();) {
    int balance = 0;
    const std::size_t first = i;
    for (; i < ways.size() && ways[i].low == ways[first].low && ways[i].high == ways[first].high; ++i)
      balance += ways[i].balance;
    if (balance != 0) return exact::require_solid(exact::build_complex(mesh));
  }
}

}  // namespace clues::fastpath
