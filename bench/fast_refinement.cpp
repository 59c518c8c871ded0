// Refinement (D20, D21) in the fast path, in one street cell of a generated city: what it takes out and what it costs, and how long the exact reference takes for the same
// depth. All threads unless a number is given.
#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "exact/convex_cell.h"
#include "fastpath/visibility/refinement.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/backprojection.h"
#include "reference/visibility/bounds.h"
#include "reference/visibility/subdivision.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint64_t kSeed = 1;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

clues::fastpath::RefinementOptions options_of(clues::fastpath::RefineBy by, int depth, bool regions) {
  clues::fastpath::RefinementOptions options;
  options.by = by;
  options.max_depth = depth;
  options.regions = regions;
  return options;
}

void fast(std::uint32_t size) {
  const auto mesh = clues::fuzz::make_city(size, kSeed);
  const auto cell = clues::fuzz::street_cell(size, kSeed);
  const clues::fastpath::Bvh bvh(mesh);
  for (const auto by : {clues::fastpath::RefineBy::cells, clues::fastpath::RefineBy::backprojection}) {
    for (const bool regions : {false, true}) {
      for (const int depth : {0, 1, 2, 3, 4}) {
        if (regions && depth > 2) continue;
        std::vector<double> times;
        clues::fastpath::RefinedVisibility found;
        for (int i = 0; i < 3; ++i) {
          const auto start = Clock::now();
          found = refined_visibility(bvh, cell, {}, options_of(by, depth, regions));
          times.push_back(seconds_since(start));
        }
        std::sort(times.begin(), times.end());
        const auto& last = found.depths.back();
        fmt::print("{:>9} {:>15} {:>7} {:>5} {:>9.3f} {:>11} {:>8} {:>9} {:>5} {:>10} {:>9} {:>12.6g} {:>12.6g}\n",
                   mesh.triangles.size(), by == clues::fastpath::RefineBy::cells ? "cells" : "backprojection",
                   regions ? "yes" : "no", last.depth, times[1], found.first_order.visible.size(), found.visible.size(),
                   last.witnessed, last.maps, last.viewpoints,
                   found.first_order.conservative_fallbacks + found.conservative_fallbacks, last.witnessed_area,
                   last.refined_area);
      }
    }
  }
}

void exact(std::uint32_t size, int depth) {
  const auto mesh = clues::fuzz::make_city(size, kSeed);
  const auto cell = clues::exact::ConvexCell::from_doubles(clues::fuzz::street_cell(size, kSeed));
  clues::reference::Options options;
  options.threads = tbb::this_task_arena::max_concurrency();
  for (const bool backprojection : {false, true}) {
    const auto start = Clock::now();
    clues::reference::Bounds bounds(mesh, cell, options);
    const auto depths =
        backprojection ? refine_by_backprojection(bounds, {depth, 0}) : refine_by_cells(bounds, {depth, 0});
    const auto visible = bounds.refined_map("").visible;
    fmt::print("{:>9} {:>15} {:>7} {:>5} {:>9.3f} {:>11} {:>8} {:>9} {:>5} {:>10} {:>9} {:>12.6g} {:>12.6g}\n",
               mesh.triangles.size(), backprojection ? "exact backproj." : "exact cells", "yes", depths.back().depth,
               seconds_since(start), bounds.first_order().visible.size(), visible.size(), "", bounds.maps(),
               bounds.viewpoints(), bounds.fallbacks(), bounds.area().lower, bounds.area().upper);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  tbb::task_arena arena(argc > 1 ? std::atoi(argv[1]) : tbb::task_arena::automatic);
  arena.execute([] {
    fmt::print("{} threads\n{:>9} {:>15} {:>7} {:>5} {:>9} {:>11} {:>8} {:>9} {:>5} {:>10} {:>9} {:>12} {:>12}\n",
               tbb::this_task_arena::max_concurrency(), "triangles", "by", "regions", "depth", "seconds", "first-order",
               "refined", "witnessed", "maps", "viewpoints", "fallbacks", "seen area", "refined area");
    for (const std::uint32_t size : {300U, 1000U, 10000U}) fast(size);
    exact(300, 1);
    exact(1000, 1);
  });
}
