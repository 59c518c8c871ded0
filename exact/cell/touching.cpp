#include "exact/cell/touching.h"

#include <algorithm>

namespace clues::exact {
namespace {

// A side of `a` has all of `b` strictly before it.
bool parted_by_a_side(const ConvexCell& a, const ConvexCell& b) {
  return std::any_of(a.facets().begin(), a.facets().end(), [&](const CellFacet& side) {
    return std::all_of(b.vertices().begin(), b.vertices().end(),
                       [&](const Point3& p) { return side.plane.has_on_positive_side(p); });
  });
}

}  // namespace

std::vector<std::vector<std::uint32_t>> touching_cells(const std::vector<ConvexCell>& cells) {
  std::vector<CGAL::Bbox_3> boxes;
  for (const ConvexCell& cell : cells) {
    boxes.emplace_back();
    for (const Point3& p : cell.vertices()) boxes.back() += p.bbox();
  }
  std::vector<std::vector<std::uint32_t>> out(cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    for (std::uint32_t j = i + 1; j < cells.size(); ++j) {
      if (!CGAL::do_overlap(boxes[i], boxes[j])) continue;
      if (parted_by_a_side(cells[i], cells[j]) || parted_by_a_side(cells[j], cells[i])) continue;
      out[i].push_back(j);
      out[j].push_back(i);
    }
  }
  for (auto& list : out) std::sort(list.begin(), list.end());
  return out;
}

}  // namespace clues::exact
