#include "exact/complex/cell_cut.h"

#include <algorithm>
#include <array>
#include <utility>

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
    if (CGAL::sign(at_a) * CGAL::sign(at_b) < 0) kept.push_back(zero_on_line(a, b, at_a, at_b));
  }
  return ConvexCell(kept);
}

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
  const Plane3 plane(n[0], n[1], n[2], collapsed(FT(-middle)));
  std::vector<ConvexCell> parts;
  for (const Side side : {Side::negative, Side::positive}) {
    if (auto part = part_beside(cell, plane, side)) parts.push_back(std::move(*part));
  }
  return parts;
}

std::vector<std::vector<Point3>> Viewpoints::up_to(int depth) {
  std::vector<std::vector<Point3>> by_halvings;
  for (; halvings_ <= depth + depth / 2; ++halvings_) {
    if (halvings_ > 0) {
      std::vector<ConvexCell> finer;
      for (const ConvexCell& part : parts_) {
        for (ConvexCell& half : halves(part)) finer.push_back(std::move(half));
      }
      parts_ = std::move(finer);
    }
    by_halvings.emplace_back();
    for (const ConvexCell& part : parts_) {
      std::vector<Point3> points = part.vertices();
      points.push_back(part.center());
      for (const Point3& v : points) {
        if (halvings_ > 0 && cell_.dimension() == 3 && cell_.interior_contains(v)) continue;
        if (std::find(given_.begin(), given_.end(), v) != given_.end()) continue;
        given_.push_back(v);
        by_halvings.back().push_back(v);
      }
    }
  }
  return by_halvings;
}

}  // namespace clues::exact
