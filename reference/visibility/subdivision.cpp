#include "reference/visibility/subdivision.h"

#include <algorithm>
#include <utility>

#include "exact/cell_cut.h"

namespace clues::reference {

using exact::ConvexCell;
using exact::FT;
using exact::Point3;

namespace {

struct Part {
  ConvexCell cell;
  SideSets seen;
};

bool sees_more(const Part& part, const Bounds& bounds, const std::vector<bool>& open) {
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] && !subtract(part.seen[i], bounds.lower()[i]).empty()) return true;
  }
  return false;
}

DepthFigures figures(int depth, std::size_t cells, const Bounds& bounds) {
  return {depth, cells, bounds.maps(), bounds.viewpoints(), bounds.area()};
}

void look_from(const ConvexCell& cell, Bounds& bounds) {
  for (const Point3& v : cell.vertices()) bounds.add_viewpoint(v);
  bounds.add_viewpoint(cell.center());
}

}  // namespace

std::vector<ConvexCell> halves(const ConvexCell& cell) {
  std::size_t longest = 0;
  FT extent(0), middle(0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Point3& a, const Point3& b) { return a[axis] < b[axis]; };
    const auto [lo, hi] = std::minmax_element(cell.vertices().begin(), cell.vertices().end(), less);
    const FT size = (*hi)[axis] - (*lo)[axis];
    if (size <= extent) continue;
    extent = size;
    longest = static_cast<std::size_t>(axis);
    middle = ((*hi)[axis] + (*lo)[axis]) / FT(2);
  }
  if (extent == FT(0)) return {cell};
  std::array<FT, 3> n{FT(0), FT(0), FT(0)};
  n[longest] = FT(1);
  const exact::Plane3 plane(n[0], n[1], n[2], exact::collapsed(FT(-middle)));
  std::vector<ConvexCell> parts;
  for (const exact::Side side : {exact::Side::negative, exact::Side::positive}) {
    if (auto part = exact::part_beside(cell, plane, side)) parts.push_back(std::move(*part));
  }
  return parts;
}

std::vector<DepthFigures> refine_by_cells(Bounds& bounds, const RefineOptions& options, const DepthReport& report) {
  std::vector<DepthFigures> depths;
  const auto note = [&](int depth, std::size_t cells) {
    depths.push_back(figures(depth, cells, bounds));
    if (report) report(depths.back());
  };
  std::vector<Part> parts{{bounds.first_order().cell, bounds.upper()}};
  look_from(parts[0].cell, bounds);
  note(0, 1);
  for (int depth = 1; depth <= options.max_depth; ++depth) {
    std::vector<bool> open = bounds.open_sides();
    if (std::none_of(open.begin(), open.end(), [](bool o) { return o; })) break;
    if (depths.back().area.excess() <= options.tolerance_area) break;
    std::vector<Part> next;
    for (Part& part : parts) {
      const std::vector<ConvexCell> cut = halves(part.cell);
      if (cut.size() < 2 || !sees_more(part, bounds, open)) {
        next.push_back(std::move(part));
        continue;
      }
      for (const ConvexCell& cell : cut) next.push_back({cell, bounds.sets_of(bounds.map_of(cell, open))});
      // A side that is open no more keeps its upper bound: what the parts see there is not asked again.
    }
    parts = std::move(next);
    SideSets all = parts[0].seen;
    for (std::size_t i = 1; i < parts.size(); ++i) all = unite(all, parts[i].seen);
    bounds.restrict_to(all, open);
    for (const Part& part : parts) look_from(part.cell, bounds);
    note(depth, parts.size());
  }
  return depths;
}

}  // namespace clues::reference
