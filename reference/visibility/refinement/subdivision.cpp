#include "reference/visibility/refinement/subdivision.h"

#include <algorithm>
#include <utility>

#include "exact/complex/cell_cut.h"

namespace clues::reference {

using exact::ConvexCell;

namespace {

struct SubCell {
  ConvexCell cell;
  SideSets seen;
};

bool sees_more(const SubCell& part, const Bounds& bounds, const std::vector<bool>& open) {
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] && !subtract(part.seen[i], bounds.lower()[i]).empty()) return true;
  }
  return false;
}

DepthFigures figures(int depth, std::size_t cells, const Bounds& bounds) {
  return {depth, cells, bounds.maps(), bounds.viewpoints(), bounds.area()};
}

}  // namespace

std::vector<DepthFigures> refine_by_cells(Bounds& bounds, const RefineOptions& options, const DepthReport& report) {
  std::vector<DepthFigures> depths;
  const auto note = [&](int depth, std::size_t cells) {
    depths.push_back(figures(depth, cells, bounds));
    if (report) report(depths.back());
  };
  std::vector<SubCell> parts{{bounds.first_order().cell, bounds.upper()}};
  bounds.look_around(0);
  note(0, 1);
  for (int depth = 1; depth <= options.max_depth; ++depth) {
    std::vector<bool> open = bounds.open_sides();
    if (std::none_of(open.begin(), open.end(), [](bool o) { return o; })) break;
    if (depths.back().area.excess() <= bounds.range().area_moved_in(options.tolerance_area)) break;
    std::vector<SubCell> next;
    for (SubCell& part : parts) {
      const std::vector<ConvexCell> cut = exact::halves(part.cell);
      if (cut.size() < 2 || !sees_more(part, bounds, open)) {
        next.push_back(std::move(part));
        continue;
      }
      for (const ConvexCell& cell : cut) next.push_back({cell, bounds.sets_of(bounds.map_of(cell, open))});
      // A side that is open no more keeps its upper bound: what the parts see there is not asked again.
    }
    parts = std::move(next);
    SideSets all = parts[0].seen;
    for (std::size_t i = 1; i < parts.size(); ++i) all = bounds.united(all, parts[i].seen);
    bounds.restrict_to(all, open);
    bounds.look_around(depth);
    note(depth, parts.size());
  }
  return depths;
}

}  // namespace clues::reference
