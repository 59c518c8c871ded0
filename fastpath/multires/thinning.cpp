#include "fastpath/multires/thinning.h"

#include <algorithm>

#include "fastpath/multires/grid_signs.h"

namespace clues::fastpath::multires {
namespace {

using exact::Wide;
using scene::CarrierPoint;

// Whether a point may move to another place on the input: inside of a triangle anywhere, on an edge along it.
bool may_slide(const CarrierPoint& from, const CarrierPoint& to) {
  if (from.size() == 3) return true;
  if (from.size() != 2) return false;
  const auto on_it = [&](std::size_t k) {
    return to.corner[k] == scene::no_vertex || to.corner[k] == from.corner[0] || to.corner[k] == from.corner[1];
  };
  return on_it(0) && on_it(1) && on_it(2);
}

}  // namespace

void Thinning::thin(const scene::Triangle& triangle, const std::vector<scene::Triangle>& input,
                    const StarPoints& points, std::vector<StarPart>& parts) {
  candidates_.clear();
  changed_.resize(std::max(changed_.size(), points.size()));
  for (const StarPart& part : parts) {
    for (const std::uint32_t p : part.corners) {
      if (points.may_go[p] == 0 || changed_[p] != 0) continue;
      changed_[p] = 1;
      candidates_.push_back(p);
    }
  }
  if (candidates_.empty()) return;
  std::sort(candidates_.begin(), candidates_.end());
  input_ = &input;
  points_ = &points;
  parts_ = &parts;
  gone_.assign(parts.size(), 0);
  at_.resize(points.size());
  if (around_.size() < points.size()) around_.resize(points.size());
  for (const StarPart& part : parts) {
    for (const std::uint32_t p : part.corners) around_[p].clear();
  }
  for (std::uint32_t k = 0; k < parts.size(); ++k) {
    for (const std::uint32_t p : parts[k].corners) {
      if (around_[p].empty()) at_[p] = place_in(triangle, points.image[p]);
      around_[p].push_back(k);
    }
  }
  for (bool again = true; again;) {
    again = false;
    left_.clear();
    for (const std::uint32_t p : candidates_) {
      if (changed_[p] != 0 && take_out(p)) {
        again = true;
      } else {
        changed_[p] = 0;
        left_.push_back(p);
      }
    }
    candidates_.swap(left_);
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const std::uint32_t p : parts[k].corners) changed_[p] = 0;
    if (gone_[k] == 0) parts[kept++] = parts[k];
  }
  parts.resize(kept);
}

// The smallest image that would be left with the point at the target; 0 where that is not allowed, or not above `best`.
Wide Thinning::smallest_left(std::uint32_t point, std::uint32_t target, Wide best) const {
  Wide smallest = 0;
  std::size_t shared = 0;
  for (const std::uint32_t k : around_[point]) {
    const auto& c = (*parts_)[k].corners;
    if (c[0] == target || c[1] == target || c[2] == target) {
      ++shared;
      continue;
    }
    const auto moved = [&](std::size_t i) { return at_[c[i] == point ? target : c[i]]; };
    const Wide left = area_of(moved(0), moved(1), moved(2));
    if (left <= best) return 0;
    if (smallest == 0 || left < smallest) smallest = left;
  }
  if (shared != 2) return 0;
  for (const std::uint32_t k : around_[point]) {
    const auto& part = (*parts_)[k];
    const auto& c = part.corners;
    if (c[0] == target || c[1] == target || c[2] == target) continue;
    const auto& t = (*input_)[part.input];
    const auto moved = [&](std::size_t i) { return place_in(t, points_->source[c[i] == point ? target : c[i]]); };
    if (area_of(moved(0), moved(1), moved(2)) <= 0) return 0;
  }
  return smallest;
}

bool Thinning::take_out(std::uint32_t point) {
  neighbours_.clear();
  for (const std::uint32_t k : around_[point]) {
    for (const std::uint32_t q : (*parts_)[k].corners) {
      if (q != point && may_slide(points_->source[point], points_->source[q]) &&
          std::find(neighbours_.begin(), neighbours_.end(), q) == neighbours_.end()) {
        neighbours_.push_back(q);
      }
    }
  }
  std::sort(neighbours_.begin(), neighbours_.end());
  Wide best = 0;
  std::uint32_t target = point;
  for (const std::uint32_t q : neighbours_) {
    const Wide smallest = smallest_left(point, q, best);
    if (smallest > best) {
      best = smallest;
      target = q;
    }
  }
  if (target == point) return false;
  for (const std::uint32_t k : around_[point]) {
    auto& corners = (*parts_)[k].corners;
    for (const std::uint32_t q : corners) changed_[q] = 1;
    if (std::find(corners.begin(), corners.end(), target) != corners.end()) {
      gone_[k] = 1;
      for (const std::uint32_t q : corners) {
        if (q == point) continue;
        auto& others = around_[q];
        others.erase(std::remove(others.begin(), others.end(), k), others.end());
      }
    } else {
      std::replace(corners.begin(), corners.end(), point, target);
      around_[target].push_back(k);
    }
  }
  around_[point].clear();
  changed_[point] = 0;
  return true;
}

}  // namespace clues::fastpath::multires
