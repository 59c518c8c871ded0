#include "fastpath/visibility/first_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "exact/complex/complex.h"
#include "exact/threads.h"
#include "fastpath/visibility/engine_part.h"

namespace clues::fastpath {
namespace {

FirstOrder by_closure(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                      const FirstOrderAsked& asked) {
  LocalMapOptions without_end = options;
  without_end.effort = 0;  // there are regions of a map that is made to its end only
  exact::CutMemory memory;
  // In solid mode what light meets is not listed where it meets backs alone, which the last map has to tell.
  const Wanted wanted = asked.regions || options.mode == SideMode::solid ? Wanted::map : Wanted::list;
  ClosedScene closed = close_by_engine(bvh, cell, without_end, outside_of(bvh), memory, {}, {}, wanted);
  LocalMap map = *closed.map();
  FirstOrder result;
  if (wanted == Wanted::list) {
    result.visible = closed.closure.visible;
  } else {
    for (const std::uint32_t t : map.visible()) result.visible.push_back(closed.closure.part[t]);
  }
  if (asked.regions) result.regions = map.regions();
  for (LocalRegion& region : result.regions) region.triangle = closed.closure.part[region.triangle];
  result.counts = map.counts();
  result.closure = closed.closure.counts;
  result.conservative_fallbacks = closed.fallbacks();
  if (asked.in_doubt) {
    for (const std::uint32_t t : map.find_in_doubt()) result.in_doubt.push_back(closed.closure.part[t]);
  }
  result.part = std::move(closed.closure.part);
  return result;
}

}  // namespace

FirstOrder first_order_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                  const FirstOrderAsked& asked) {
  return exact::by_dialed_threads(options.dials.threads, [&] {
    const exact::StandardRange range(bvh.mesh(), cell);
    if (!range.moves()) return by_closure(bvh, cell, options, asked);
    const scene::TriangleMesh mesh = range.moved_in(bvh.mesh());
    FirstOrder result = by_closure(Bvh(mesh), range.moved_in(cell), options, asked);
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
