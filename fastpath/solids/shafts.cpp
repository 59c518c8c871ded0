#include "fastpath/solids/shafts.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "fastpath/solids/view_cell.h"

namespace clues::fastpath::solids {
namespace {

using Polygon = std::vector<Point>;

// How many shafts may be looked at for a proof about one opening of the cell.
constexpr std::uint32_t kShaftsOfABox = 2, kShaftsOfATriangle = 300;
constexpr int kDeepest = 16;             // cuts of a shaft within one another
constexpr std::size_t kMostPlanes = 24;  // that are tried for one shaft
constexpr std::size_t kProbes = 6;       // segments that look for a way that is free, before a proof is tried
constexpr double kProbesWithin = 0.9;    // of the way from the middle to the corners
constexpr double kSmallest = 0x1p-14;    // of the scale: what is no longer cut

double length_along(const Bounds& box, std::size_t axis) { return box.high[axis] - box.low[axis]; }

// A node of the targets, and the openings of which it is not proved that no line through them gets there.
struct OpenNode {
  std::uint32_t node = 0;
  std::vector<Opening> openings;
};

class Prover {
 public:
  explicit Prover(const Solids& solids) : solids_(solids) {}

  // Whether no line from the window to the target is free.
  bool prove(const Piece& window, const Piece& target, bool is_triangle) {
    if (finds_a_way(window.corners, target.corners)) return false;
    left_ = is_triangle ? kShaftsOfATriangle : kShaftsOfABox;
    cuts_targets_ = is_triangle;
    return prove_shaft(window, target, 0);
  }

 private:
  bool finds_a_way(const Polygon& window, const Polygon& target) {
    const Point of_window = middle_of(window), of_target = middle_of(target);
    for (std::size_t i = 0; i < kProbes; ++i) {
      const Point &a = window[i % window.size()], &b = target[(7 * i + 3) % target.size()];
      Point from{}, to{};
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] = of_window[k] + kProbesWithin * (a[k] - of_window[k]);
        to[k] = of_target[k] + kProbesWithin * (b[k] - of_target[k]);
      }
      if (!solids_.pierces_any(from, to, stops_probes_)) return true;
    }
    return false;
  }

  bool prove_shaft(const Piece& window, const Piece& target, int depth) {
    if (left_ == 0) return false;
    --left_;
    if (recent_ && solids_.section(*recent_).covers(window, target)) return true;
    solids_.find_pierced(middle_of(window.corners), middle_of(target.corners), pierced_);
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
        if (plane == recent_ || !solids_.section(plane).covers(window, target)) continue;
        recent_ = plane;
        return true;
      }
    }
    if (depth == kDeepest) return false;
    const Bounds of_window = scene::bounds_of(window.corners), of_target = scene::bounds_of(target.corners);
    const std::size_t along_window = longest_axis(of_window), along_target = longest_axis(of_target);
    const double window_length = length_along(of_window, along_window),
                 target_length = length_along(of_target, along_target);
    const bool cuts_window = !cuts_targets_ || window_length >= target_length;
    if ((cuts_window ? window_length : target_length) < kSmallest * solids_.scale().largest) return false;
    if (cuts_window) {
      for (const Piece& part : halves_of(window, of_window, along_window)) {
        if (!prove_shaft(part, target, depth + 1)) return false;
      }
    } else {
      for (const Piece& part : halves_of(target, of_target, along_target)) {
        if (!prove_shaft(window, part, depth + 1)) return false;
      }
    }
    return true;
  }

  const Solids& solids_;
  std::uint32_t left_ = 0;  // shafts that may still be looked at
  bool cuts_targets_ = false;
  std::uint32_t stops_probes_ = 0;       // the solid that the last probe met
  std::optional<std::uint32_t> recent_;  // the plane of the last proof: often that of the next one, too
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
    const Piece piece(target);
    const bool may_be_hidden = view.may_be_hidden(target);
    if (may_be_hidden) {
      std::size_t left = 0;
      for (const Opening& opening : next.openings) {
        const Window& window = view.windows()[opening.window];
        if (!view.may_be_left_through(window, target)) continue;
        if ((node.is_triangle() && left > 0) ||  // one is enough: it is listed
            !prover.prove(window.open[opening.part], piece, node.is_triangle()))
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
