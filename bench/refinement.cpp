// Both refinements side by side, depth by depth, on scenes with EEE events and on one street cell of a generated city: how much less is called visible, and for how
// much work. One thread, processor time. The excess of a depth is counted against what is witnessed at the greatest depth of either: what more viewpoints find is no merit
// of an upper bound. An argument is the greatest depth of the small scenes (default 4).
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "fuzz/generators/city.h"
#include "fuzz/generators/skew_edges.h"
#include "reference/visibility/refinement/backprojection.h"

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Row {
  clues::reference::DepthFigures figures;
  double seconds = 0;
};

std::vector<Row> measure(const clues::fuzz::GeneratedScene& scene, bool by_cells, bool retract, int max_depth) {
  clues::reference::Options options;
  options.threads = 1;
  std::vector<Row> rows;
  const double start = processor_seconds();
  clues::reference::Bounds bounds(scene.mesh, clues::exact::ConvexCell::from_doubles(scene.cell), options);
  const auto report = [&](const clues::reference::DepthFigures& d) {
    rows.push_back({d, processor_seconds() - start});
  };
  const clues::reference::RefineOptions refine{max_depth, 0, retract};
  if (by_cells) {
    clues::reference::refine_by_cells(bounds, refine, report);
  } else {
    clues::reference::refine_by_backprojection(bounds, refine, report);
  }
  return rows;
}

void compare(const clues::fuzz::GeneratedScene& scene, int max_depth) {
  const char* names[] = {"cell", "backprojection", "with retraction"};
  const std::vector<Row> rows[] = {measure(scene, true, false, max_depth), measure(scene, false, false, max_depth),
                                   measure(scene, false, true, max_depth)};
  double witnessed = 0;
  for (const auto& kind : rows) witnessed = std::max(witnessed, kind.back().figures.area.lower);
  fmt::print("{}: {} triangles, witnessed {:.6g}\n", scene.name, scene.mesh.triangles.size(), witnessed);
  fmt::print("{:>16} {:>6} {:>12} {:>10} {:>10} {:>6} {:>15} {:>11} {:>9}\n", "refinement", "depth", "refined", "above",
             "excess", "maps", "backprojections", "viewpoints", "cpu s");
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Row& r : rows[k]) {
      const auto& d = r.figures;
      fmt::print("{:>16} {:>6} {:>12.6g} {:>10.4g} {:>10.4g} {:>6} {:>15} {:>11} {:>9.1f}\n", names[k], d.depth,
                 d.area.upper, d.area.upper - witnessed, d.area.excess(), d.maps, d.backprojections, d.viewpoints,
                 r.seconds);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int depth = argc > 1 ? std::atoi(argv[1]) : 4;
  for (const auto& scene : {clues::fuzz::two_slits(), clues::fuzz::three_skew_edges(), clues::fuzz::keyhole()})
    compare(scene, depth);
  constexpr std::uint32_t kTriangles = 300;
  constexpr std::uint64_t kSeed = 1;
  compare({"city", clues::fuzz::make_city(kTriangles, kSeed), clues::fuzz::street_cell(kTriangles, kSeed), false},
          std::min(depth, 2));
}
