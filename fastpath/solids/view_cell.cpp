#include "fastpath/solids/view_cell.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "exact/cell/convex_cell.h"

namespace clues::fastpath::solids {
namespace {

constexpr double kSmallestOpening = 0x1p-9;  // of the scale
constexpr double kMostlyOpenFacet = 0.5;     // then it is not cut up

// Of a convex polygon.
double area_of(const std::vector<Point>& polygon) {
  Point twice{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t u = (i + 1) % 3, v = (i + 2) % 3;
      const Point &a = polygon[0], &b = polygon[k], &c = polygon[k + 1];
      twice[i] += (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    }
  }
  return std::hypot(twice[0], twice[1], twice[2]) / 2;
}

// Parts of a facet that have in their union all through which lines may leave the cell. The others are in a solid each: and where that has a side in the plane of the facet, it lies behind it.
void add_open_parts(const Piece& piece, const Side& facet, const Solids& solids, std::vector<Piece>& open) {
  const auto is_filled_by = [&](std::uint32_t i) {
    const Solid& solid = solids.all()[i];
    return std::all_of(solid.sides.begin(), solid.sides.end(), [&](const Side& side) {
      return is_inside(side, piece, solids.scale()) && (!side.has_all_on(piece.whole) || facet.has_none_inside(solid));
    });
  };
  const Bounds box = scene::bounds_of(piece.corners);
  const auto touching = solids.touching(box);
  if (std::any_of(touching.begin(), touching.end(), is_filled_by)) return;
  const std::size_t axis = longest_axis(box);
  if (touching.empty() || box.high[axis] - box.low[axis] < kSmallestOpening * solids.scale().largest) {
    open.push_back(piece);
    return;
  }
  const std::size_t before = open.size();
  for (const Piece& half : halves_of(piece, box, axis)) add_open_parts(half, facet, solids, open);
  if (open.size() - before < 2) return;
  double area = 0;
  for (std::size_t i = before; i < open.size(); ++i) area += area_of(open[i].corners);
  if (area < kMostlyOpenFacet * area_of(piece.corners)) return;
  open.resize(before);
  open.push_back(piece);
}

}  // namespace

ViewCell::ViewCell(const std::vector<Point>& points, const Solids& solids) {
  const auto cell = exact::ConvexCell::from_doubles(points);
  for (const auto& p : cell.vertices()) corners_.push_back(exact::to_double_estimate(p));  // they are doubles
  bounds_ = scene::bounds_of(corners_);
  solid_ = cell.dimension() == 3;
  if (solid_) {
    for (const auto& facet : cell.facets()) {
      Window window;
      for (const int i : facet.corners) window.facet.push_back(corners_[static_cast<std::size_t>(i)]);
      window.side = side_through(window.facet[0], window.facet[1], window.facet[2]);
      if (window.side.flat) {
        const FilledPlane& filled = solids.filled(*window.side.flat);
        window.open = filled.open_parts(window.facet, kSmallestOpening * solids.scale().largest);
      } else {
        add_open_parts(Piece(window.facet), window.side, solids, window.open);
      }
      windows_.push_back(std::move(window));
    }
  } else {
    std::vector<Point> all = corners_;
    if (cell.dimension() == 2) {
      all.clear();
      for (const int i : cell.facets()[0].corners) all.push_back(corners_[static_cast<std::size_t>(i)]);
    }
    Window& window = windows_.emplace_back();
    window.facet = std::move(all);
    window.open.emplace_back(window.facet);
  }
  for (const auto i : solids.touching(bounds_)) {
    if (!is_outside(solids.all()[i])) around_.push_back(&solids.all()[i]);
  }
}

std::vector<Opening> ViewCell::openings() const {
  std::vector<Opening> all;
  for (std::uint32_t w = 0; w < windows_.size(); ++w) {
    for (std::uint32_t i = 0; i < windows_[w].open.size(); ++i) all.push_back({w, i});
  }
  return all;
}

bool ViewCell::may_be_hidden(const std::vector<Point>& target) const {
  return is_apart_from(target) && is_out_of_solids_around(target);
}

bool ViewCell::may_be_left_through(const Window& window, const std::vector<Point>& target) const {
  return !solid_ || !window.side.has_none_outside(target);
}

bool ViewCell::is_behind(const std::vector<Side>& backs) const {
  return std::any_of(backs.begin(), backs.end(), [this](const Side& s) { return s.has_none_outside(corners_); });
}

// With certainty.
bool ViewCell::is_apart_from(const std::vector<Point>& target) const {
  if (!scene::touch(bounds_, scene::bounds_of(target))) return true;
  return solid_ &&
         std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) { return w.side.has_all_outside(target); });
}

// Of solids that the viewer may be in: whether the target is out of all of them.
bool ViewCell::is_out_of_solids_around(const std::vector<Point>& target) const {
  return std::all_of(around_.begin(), around_.end(), [&](const Solid* solid) {
    return std::any_of(solid->sides.begin(), solid->sides.end(),
                       [&](const Side& side) { return side.has_all_outside(target); });
  });
}

// Whether no inner point of the cell is in the solid's interior; a flat cell must not touch it.
bool ViewCell::is_outside(const Solid& solid) const {
  if (!solid_) {
    return std::any_of(solid.sides.begin(), solid.sides.end(),
                       [&](const Side& side) { return side.has_all_outside(corners_); });
  }
  return std::any_of(solid.sides.begin(), solid.sides.end(),
                     [&](const Side& side) { return side.has_none_inside(corners_); }) ||
         std::any_of(windows_.begin(), windows_.end(), [&](const Window& w) { return w.side.has_none_inside(solid); });
}

}  // namespace clues::fastpath::solids
