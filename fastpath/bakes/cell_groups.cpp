#include "fastpath/bakes/cell_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "scene/mesh/halved.h"

namespace clues::fastpath::bakes {
namespace {

using scene::Bounds;
using scene::Point;

class Builder {
 public:
  Builder(const std::vector<scene::BakePlace>& cells, std::size_t most) : most_(most) {
    groups_.boxes.emplace_back();
    for (const auto& cell : cells) bounds_.push_back(scene::bounds_of(cell.points));
    groups_.group_of.resize(cells.size());
  }

  CellGroups build() {
    std::vector<std::uint32_t> all(bounds_.size());
    std::iota(all.begin(), all.end(), 0U);
    split(all);
    return std::move(groups_);
  }

 private:
  // T6 asks for solid boxes that hold the insides of the cells in theirs. That of a flat cell, a segment or a point may lie in the
  // border of the box; then that side is moved out by an eighth, or by as little as doubles can. So is one of no width.
  Bounds around_insides(std::span<const std::uint32_t> cells, const Bounds& b) const {
    constexpr double kMost = std::numeric_limits<double>::max();
    Bounds around = b;
    double widest = 0;
    for (std::size_t i = 0; i < 3; ++i) widest = std::max(widest, b.high[i] / 8 - b.low[i] / 8);
    for (std::size_t i = 0; i < 3; ++i) {
      const double by = b.low[i] == b.high[i] ? widest : b.high[i] / 8 - b.low[i] / 8;
      for (const auto c : cells) {
        if (bounds_[c].low[i] != bounds_[c].high[i]) continue;
        if (bounds_[c].low[i] == b.low[i]) around.low[i] = std::min(b.low[i] - by, std::nextafter(b.low[i], -kMost));
        if (bounds_[c].high[i] == b.high[i])
          around.high[i] = std::max(b.high[i] + by, std::nextafter(b.high[i], kMost));
      }
      around.low[i] = std::max(around.low[i], -kMost);
      around.high[i] = std::min(around.high[i], kMost);
    }
    return around;
  }

  void split(std::span<std::uint32_t> cells) {
    if (cells.size() <= 1) return;
    if (cells.size() <= most_) {
      for (const auto c : cells) groups_.group_of[c] = static_cast<std::uint32_t>(groups_.boxes.size());
      groups_.boxes.push_back(scene::corners_of(around_insides(cells, scene::bounds_around(cells, bounds_))));
      return;
    }
    const std::size_t half = scene::halve(cells, bounds_);
    split(cells.first(half));
    split(cells.subspan(half));
  }

  const std::size_t most_;
  std::vector<Bounds> bounds_;
  CellGroups groups_;
};

}  // namespace

CellGroups groups_of(const std::vector<scene::BakePlace>& cells, std::size_t most) {
  return Builder(cells, most).build();
}

void add_groups(scene::BakePlan& plan, std::size_t most) {
  constexpr std::size_t neighbours = 4;
  const bool boxes = most > 1;
  auto groups = groups_of(plan.cells, boxes ? most : neighbours);
  plan.nodes.clear();
  for (auto& box : groups.boxes)
    plan.nodes.push_back({"", 0, boxes ? std::move(box) : std::vector<scene::Point>{}, {}, -1});
  for (std::size_t i = 0; i < plan.cells.size(); ++i) plan.cells[i].node = groups.group_of[i];
}

}  // namespace clues::fastpath::bakes
