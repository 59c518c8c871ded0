#include "fastpath/solids/shafts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "exact/cell/convex_cell.h"

namespace clues::fastpath::solids {
namespace {

using Polygon = std::vector<Point>;

// How many shafts may be looked at for a proof about one opening of the cell.
constexpr std::uint32_t kShaftsOfABox = 2, kShaftsOfATriangle = 150;
constexpr int kDeepest = 12;                 // cuts of a shaft within one another
constexpr std::size_t kMostPlanes = 24;      // that are tried for one shaft
constexpr std::size_t kProbes = 6;           // segments that look for a way that is free, before a proof is tried
constexpr double kProbesWithin = 0.9;        // of the way from the middle to the corners
constexpr double kSmallestOpening = 0x1p-9;  // of the scale
constexpr double kSmallest = 0x1p-14;        // of the scale: what is no longer cut

Point middle_of(std::span<const Point> points) {
  Point middle{};
  for (const Point& p : points) {
    for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / static_cast<double>(points.size());
  }
  return middle;
}

double length_along(const Bounds& box, std::size_t axis) { return box.high[axis] - box.low[axis]; }

// In the middle of the axis: both have all of the polygon in their union, but for roundings.
std::array<Polygon, 2> halves_of(const Polygon& polygon, const Bounds& box, std::size_t axis) {
  const double middle = (box.low[axis] + box.high[axis]) / 2;
  return {clipped(polygon, axis, middle, false), clipped(polygon, axis, middle, true)};
}

// A facet of the cell, and where of it sight lines may leave the cell.
struct Window {
  Polygon facet;
  Side side;
  std::vector<Polygon> open;
};

struct Opening {
  std::uint32_t window = 0, part = 0;
};

// A node of the targets, and the openings of which it is not proved that no line through them gets there.
struct OpenNode {
  std::uint32_t node = 0;
  std::vector<Opening> openings;
};

// The cell as the proofs need it.
class ViewCell {
 public:
  ViewCell(const std::vector<Point>& points, const Solids& solids) {
    const auto cell = exact::ConvexCell::from_doubles(points);
    for (const auto& p : cell.vertices()) corners_.push_back(exact::to_double_estimate(p));  // they are doubles
    bounds_ = scene::bounds_of(corners_);
    solid_ = cell.dimension() == 3;
    if (solid_) {
      for (const auto& facet : cell.facets()) {
        Window window;
        for (const int i : facet.corners) window.facet.push_back(corners_[static_cast<std::size_t>(i)]);
        window.side = side_through(window.facet[0], window.facet[1], window.facet[2]);
        if (const auto axis = flat_axis(window.facet)) {
          const FilledPlane& filled = solids.filled({*axis, window.facet[0][*axis], faces_up(window.side, *axis)});
          window.open = filled.open_parts(window.facet, kSmallestOpening * solids.scale().largest);
        } else {
          window.open.push_back(window.facet);
        }
        windows_.push_back(std::move(window));
      }
    } else {
      Polygon all = corners_;
      if (cell.dimension() == 2) {
        all.clear();
        for (const int i : cell.facets()[0].corners) all.push_back(corners_[static_cast<std::size_t>(i)]);
      }
      windows_.push_back({all, {}, {all}});
    }
    for (const auto i : solids.touching(bounds_)) {
      if (!is_outside(solids.all()[i])) around_.push_back(&solids.all()[i]);
    }
  }

  const std::vector<Window>& windows() const { return windows_; }
  std::vector<Opening> openings() const {
    std::vector<Opening> all;
    for (std::uint32_t w = 0; w < windows_.size(); ++w) {
      for (std::uint32_t i = 0; i < windows_[w].open.size(); ++i) all.push_back({w, i});
    }
    return all;
  }

  // Whether T15 may be used: it has no point in common with the target, and the target is out of all solids that the viewer may be in.
  bool may_be_hidden(const std::vector<Point>& target) const {
    return is_apart_from(target) && is_out_of_solids_around(target);
  }

  // Whether lines to the target may go through the window, if they are apart.
  bool may_be_left_through(const Window& window, const std::vector<Point>& target) const {
    return !solid_ || !window.side.has_none_outside(target);
  }

  // Whether it is on the inside of one of these planes.
  bool is_behind(const std::vector<Side>& backs) const {
    return std::any_of(backs.begin(), backs.end(), [this](const Side& s) { return s.has_none_outside(corners_); });
  }

 private:
  // Whether it has no point in common with the target, with certainty.
  bool is_apart_from(const std::vector<Point>& target) const {
    if (!scene::touch(bounds_, scene::bounds_of(target))) return true;
    return solid_ && std::any_of(windows_.begin(), windows_.end(),
                                 [&](const Window& w) { return w.side.has_all_outside(target); });
  }

  // Of solids that the viewer may be in: whether the target is out of all of them.
  bool is_out_of_solids_around(const std::vector<Point>& target) const {
    return std::all_of(around_.begin(), around_.end(), [&](const Solid* solid) {
      return std::any_of(solid->sides.begin(), solid->sides.end(),
                         [&](const Side& side) { return side.has_all_outside(target); });
    });
  }

  // Whether no inner point of the cell is in the solid's interior; a flat cell must not touch it.
  bool is_outside(const Solid& solid) const {
    if (!solid_) {
      return std::any_of(solid.sides.begin(), solid.sides.end(),
                         [&](const Side& side) { return side.has_all_outside(corners_); });
    }
    return std::any_of(solid.sides.begin(), solid.sides.end(),
                       [&](const Side& side) { return side.has_none_inside(corners_); }) ||
           std::any_of(windows_.begin(), windows_.end(),
                       [&](const Window& w) { return w.side.has_none_inside(solid.corners); });
  }

  std::vector<Point> corners_;
  Bounds bounds_;
  bool solid_ = false;
  std::vector<Window> windows_;
  std::vector<const Solid*> around_;
};

class Prover {
 public:
  explicit Prover(const Solids& solids) : solids_(solids) {}

  // Whether no line from the window to the target is free.
  bool prove(const Polygon& window, const Polygon& target, bool is_triangle) {
    if (finds_a_way(window, target)) return false;
    left_ = is_triangle ? kShaftsOfATriangle : kShaftsOfABox;
    cuts_targets_ = is_triangle;
    return prove_shaft(window, target, 0);
  }

 private:
  bool finds_a_way(const Polygon& window, const Polygon& target) const {
    const Point of_window = middle_of(window), of_target = middle_of(target);
    for (std::size_t i = 0; i < kProbes; ++i) {
      const Point &a = window[i % window.size()], &b = target[(7 * i + 3) % target.size()];
      Point from{}, to{};
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] = of_window[k] + kProbesWithin * (a[k] - of_window[k]);
        to[k] = of_target[k] + kProbesWithin * (b[k] - of_target[k]);
      }
      if (!solids_.pierces_any(from, to)) return true;
    }
    return false;
  }

  bool prove_shaft(const Polygon& window, const Polygon& target, int depth) {
    if (left_ == 0) return false;
    --left_;
    solids_.find_pierced(middle_of(window), middle_of(target), pierced_);
    if (pierced_.empty()) {
      left_ = 0;
      return false;
    }
    planes_.clear();
    for (const Pierced& hit : pierced_) {
      for (const auto side : {hit.side_in, hit.side_out}) {
        if (side < 0) continue;
        const auto plane = solids_.plane_behind(hit.solid, static_cast<std::uint32_t>(side));
        if (std::find(planes_.begin(), planes_.end(), plane) != planes_.end()) continue;
        if (planes_.size() == kMostPlanes) break;
        planes_.push_back(plane);
        if (solids_.section(plane).covers(window, target)) return true;
      }
    }
    if (depth == kDeepest) return false;
    const Bounds of_window = scene::bounds_of(window), of_target = scene::bounds_of(target);
    const std::size_t along_window = longest_axis(of_window), along_target = longest_axis(of_target);
    const double window_length = length_along(of_window, along_window),
                 target_length = length_along(of_target, along_target);
    const bool cuts_window = !cuts_targets_ || window_length >= target_length;
    if ((cuts_window ? window_length : target_length) < kSmallest * solids_.scale().largest) return false;
    if (cuts_window) {
      for (const Polygon& part : halves_of(window, of_window, along_window)) {
        if (!prove_shaft(part, target, depth + 1)) return false;
      }
    } else {
      for (const Polygon& part : halves_of(target, of_target, along_target)) {
        if (!prove_shaft(window, part, depth + 1)) return false;
      }
    }
    return true;
  }

  const Solids& solids_;
  std::uint32_t left_ = 0;  // shafts that may still be looked at
  bool cuts_targets_ = false;
  std::vector<Pierced> pierced_;
  std::vector<std::uint32_t> planes_;
};

// Per node whether it has a triangle that is not only seen from behind.
std::vector<std::uint8_t> not_from_behind(const ViewCell& view, const Targets& targets) {
  const auto& nodes = targets.nodes();
  std::vector<std::uint8_t> some(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    const auto& node = nodes[i];
    if (node.is_triangle()) {
      some[i] = view.is_behind(targets.backs_of(node.triangle)) && view.may_be_hidden(targets.corners_of(node)) ? 0 : 1;
    } else {
      some[i] = some[node.left] | some[node.right];
    }
  }
  return some;
}

}  // namespace

std::vector<std::uint32_t> not_hidden(const Solids& solids, const Targets& targets, const std::vector<Point>& cell) {
  std::vector<std::uint32_t> found;
  if (targets.nodes().empty()) return found;
  const ViewCell view(cell, solids);
  Prover prover(solids);
  const auto in_question = not_from_behind(view, targets);
  std::vector<OpenNode> open{{0, view.openings()}};
  while (!open.empty()) {
    OpenNode next = std::move(open.back());
    open.pop_back();
    if (in_question[next.node] == 0) continue;
    const Targets::Node& node = targets.nodes()[next.node];
    const Polygon target = targets.corners_of(node);
    const bool may_be_hidden = view.may_be_hidden(target);
    if (may_be_hidden) {
      std::size_t left = 0;
      for (const Opening& opening : next.openings) {
        const Window& window = view.windows()[opening.window];
        if (!view.may_be_left_through(window, target)) continue;
        if ((node.is_triangle() && left > 0) ||  // one is enough: it is listed
            !prover.prove(window.open[opening.part], target, node.is_triangle()))
          next.openings[left++] = opening;
      }
      next.openings.resize(left);
    }
    if (may_be_hidden && next.openings.empty()) continue;
    if (node.is_triangle()) {
      found.push_back(node.triangle);
      continue;
    }
    open.push_back({node.left, next.openings});
    open.push_back({node.right, std::move(next.openings)});
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace clues::fastpath::solids
