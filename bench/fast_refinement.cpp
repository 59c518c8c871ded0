// Refinement (D20, D21) in the fast path, in one street cell of a generated city: what it takes out and what it costs, and how long the exact reference takes for the same
// depth. Processor time of all threads together; all threads unless a number is given.
#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "fuzz/generators/city.h"
#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"

namespace {

constexpr std::uint64_t kSeed = 1;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Asked {
  const char* name;
  int depth;
  bool regions, sight_lines;
};

void print(std::size_t triangles, const char* by, const char* what, int depth, double seconds, std::size_t first_order,
           std::size_t refined, std::uint64_t maps, std::uint64_t viewpoints, std::uint64_t fallbacks, double seen,
           double area) {
  fmt::print("{:>9} {:>15} {:>12} {:>5} {:>9.3f} {:>11} {:>8} {:>5} {:>10} {:>9} {:>12.7g} {:>12.7g}\n", triangles, by,
             what, depth, seconds, first_order, refined, maps, viewpoints, fallbacks, seen, area);
}

// Triangles: only those without a sight line are asked about. Regions: what is in doubt of the others, too. All: every triangle in every part.
void fast(std::uint32_t size) {
  const auto mesh = clues::fuzz::make_city(size, kSeed);
  const auto cell = clues::fuzz::street_cell(size, kSeed);
  const clues::fastpath::Bvh bvh(mesh);
  for (const auto by : {clues::fastpath::RefineBy::cells, clues::fastpath::RefineBy::backprojection}) {
    for (const Asked& asked :
         {Asked{"triangles", 4, false, true}, Asked{"regions", 1, true, true}, Asked{"regions", 2, true, true},
          Asked{"all", 1, false, false}, Asked{"all", 2, false, false}}) {
      clues::fastpath::RefinementOptions options;
      options.by = by;
      options.max_depth = asked.depth;
      options.regions = asked.regions;
      if (!asked.sight_lines) options.sight_lines = 0;
      std::vector<double> times;
      clues::fastpath::RefinedVisibility found;
      for (int i = 0; i < 3; ++i) {
        const double start = processor_seconds();
        found = refined_visibility(bvh, cell, {}, options);
        times.push_back(processor_seconds() - start);
      }
      std::sort(times.begin(), times.end());
      const auto& last = found.depths.back();
      print(mesh.triangles.size(), by == clues::fastpath::RefineBy::cells ? "cells" : "backprojection", asked.name,
            last.depth, times[1], found.first_order.visible.size(), found.visible.size(), last.maps, last.viewpoints,
            found.first_order.conservative_fallbacks + found.conservative_fallbacks, last.witnessed_area,
            last.refined_area);
    }
  }
}

void exact(std::uint32_t size, int depth) {
  const auto mesh = clues::fuzz::make_city(size, kSeed);
  const auto cell = clues::exact::ConvexCell::from_doubles(clues::fuzz::street_cell(size, kSeed));
  clues::reference::Options options;
  options.threads = tbb::this_task_arena::max_concurrency();
  for (const bool backprojection : {false, true}) {
    const double start = processor_seconds();
    clues::reference::Bounds bounds(mesh, cell, options);
    const auto depths =
        backprojection ? refine_by_backprojection(bounds, {depth, 0}) : refine_by_cells(bounds, {depth, 0});
    const auto visible = bounds.refined_map("").visible;
    print(mesh.triangles.size(), backprojection ? "exact backproj." : "exact cells", "regions", depths.back().depth,
          processor_seconds() - start, bounds.first_order().visible.size(), visible.size(), bounds.maps(),
          bounds.viewpoints(), bounds.fallbacks(), bounds.area().lower, bounds.area().upper);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  tbb::task_arena arena(argc > 1 ? std::atoi(argv[1]) : tbb::task_arena::automatic);
  arena.execute([] {
    fmt::print("{} threads\n{:>9} {:>15} {:>12} {:>5} {:>9} {:>11} {:>8} {:>5} {:>10} {:>9} {:>12} {:>12}\n",
               tbb::this_task_arena::max_concurrency(), "triangles", "by", "asked about", "depth", "cpu s",
               "first-order", "refined", "maps", "viewpoints", "fallbacks", "seen area", "refined area");
    for (const std::uint32_t size : {300U, 1000U, 10000U}) fast(size);
    exact(300, 1);
    exact(1000, 1);
  });
}
