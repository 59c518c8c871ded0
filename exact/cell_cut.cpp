#include "exact/cell_cut.h"

namespace clues::exact {

std::optional<ConvexCell> part_beside(const ConvexCell& cell, const Plane3& plane, Side side) {
  std::vector<Point3> kept, strictly, beyond;
  for (const Point3& v : cell.vertices()) {
    const Side s = to_side(CGAL::sign(value_at(plane, v)));
    if (s == side) strictly.push_back(v);
    if (s == side || s == Side::on) kept.push_back(v);
    if (s != side && s != Side::on) beyond.push_back(v);
  }
  if (strictly.empty()) return std::nullopt;
  if (beyond.empty()) return cell;
  // The part is the hull of the vertices kept and of the crossings of the cell's edges; all other chords cross inside that.
  for (const auto& [i, j] : cell.edges()) {
    const Point3 &a = cell.vertices()[static_cast<std::size_t>(i)], &b = cell.vertices()[static_cast<std::size_t>(j)];
    const FT at_a = value_at(plane, a), at_b = value_at(plane, b);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) < 0) kept.push_back(collapsed(a + (at_a / (at_a - at_b)) * (b - a)));
  }
  return ConvexCell(kept);
}

}  // namespace clues::exact
