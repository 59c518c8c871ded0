#include "app/bake/cell_groups.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "scene/mesh/bounds.h"

namespace clues::app {
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
  Bounds bounds_of_all(std::span<const std::uint32_t> cells) const {
    Bounds b = bounds_[cells[0]];
    for (const auto c : cells) b = scene::hull_of(b, bounds_[c]);
    return b;
  }

  void split(std::span<std::uint32_t> cells) {
    if (cells.size() <= 1) return;
    const Bounds b = bounds_of_all(cells);
    if (cells.size() <= most_) {
      std::vector<Point> box;
      for (unsigned i = 0; i < 8; ++i) {
        box.push_back({(i & 1U) != 0 ? b.high[0] : b.low[0], (i & 2U) != 0 ? b.high[1] : b.low[1],
                       (i & 4U) != 0 ? b.high[2] : b.low[2]});
      }
      std::sort(box.begin(), box.end());
      box.erase(std::unique(box.begin(), box.end()), box.end());
      for (const auto c : cells) groups_.group_of[c] = static_cast<std::uint32_t>(groups_.boxes.size());
      groups_.boxes.push_back(std::move(box));
      return;
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (b.high[i] - b.low[i] > b.high[axis] - b.low[axis]) axis = i;
    }
    const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
    std::nth_element(cells.begin(), middle, cells.end(), [&](std::uint32_t a, std::uint32_t c) {
      const auto key = [&](std::uint32_t i) {
        return std::tuple(bounds_[i].low[axis] / 2 + bounds_[i].high[axis] / 2, i);
      };
      return key(a) < key(c);
    });
    split(cells.subspan(0, cells.size() / 2));
    split(cells.subspan(cells.size() / 2));
  }

  const std::size_t most_;
  std::vector<Bounds> bounds_;
  CellGroups groups_;
};

}  // namespace

CellGroups groups_of(const std::vector<scene::BakePlace>& cells, std::size_t most) {
  return Builder(cells, most).build();
}

}  // namespace clues::app
