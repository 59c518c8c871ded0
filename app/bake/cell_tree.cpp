#include "app/bake/cell_tree.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace clues::app {
namespace {

using scene::Point;

struct Bounds {
  Point low, high;
};

Bounds bounds_of(const scene::CellSpec& cell) {
  Bounds b{cell.points[0], cell.points[0]};
  for (const auto& p : cell.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      b.low[i] = std::min(b.low[i], p[i]);
      b.high[i] = std::max(b.high[i], p[i]);
    }
  }
  return b;
}

class Builder {
 public:
  Builder(const std::vector<scene::CellSpec>& cells, const std::vector<std::size_t>& groups) : groups_(groups) {
    for (const auto& cell : cells) bounds_.push_back(bounds_of(cell));
    tree_.nodes.emplace_back();
    tree_.node_of.resize(cells.size());
  }

  CellTree build() {
    std::vector<std::uint32_t> all(bounds_.size());
    std::iota(all.begin(), all.end(), 0U);
    split(all, CellTree::kRoot, 0);
    for (auto& node : tree_.nodes) std::sort(node.cells.begin(), node.cells.end());
    return std::move(tree_);
  }

 private:
  Bounds bounds_of_all(std::span<const std::uint32_t> cells) const {
    Bounds b = bounds_[cells[0]];
    for (const auto c : cells) {
      for (std::size_t i = 0; i < 3; ++i) {
        b.low[i] = std::min(b.low[i], bounds_[c].low[i]);
        b.high[i] = std::max(b.high[i], bounds_[c].high[i]);
      }
    }
    return b;
  }

  void split(std::span<std::uint32_t> cells, std::uint32_t node, std::size_t level) {
    if (level < groups_.size() && cells.size() <= groups_[level] && cells.size() > 1) {
      const Bounds b = bounds_of_all(cells);
      const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes[node].nodes.push_back(child);
      CellTree::Node made;
      made.parent = node;
      for (unsigned i = 0; i < 8; ++i) {
        made.box.push_back({(i & 1U) != 0 ? b.high[0] : b.low[0], (i & 2U) != 0 ? b.high[1] : b.low[1],
                            (i & 4U) != 0 ? b.high[2] : b.low[2]});
      }
      std::sort(made.box.begin(), made.box.end());
      made.box.erase(std::unique(made.box.begin(), made.box.end()), made.box.end());
      tree_.nodes.push_back(std::move(made));
      node = child;
      while (level < groups_.size() && cells.size() <= groups_[level]) ++level;
    }
    if (level == groups_.size() || cells.size() == 1) {
      for (const auto c : cells) {
        tree_.nodes[node].cells.push_back(c);
        tree_.node_of[c] = node;
      }
      return;
    }
    const Bounds b = bounds_of_all(cells);
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
    split(cells.subspan(0, cells.size() / 2), node, level);
    split(cells.subspan(cells.size() / 2), node, level);
  }

  const std::vector<std::size_t>& groups_;
  std::vector<Bounds> bounds_;
  CellTree tree_;
};

}  // namespace

CellTree tree_over(const std::vector<scene::CellSpec>& cells, const std::vector<std::size_t>& groups) {
  return cells.empty() ? CellTree{{{}}, {}} : Builder(cells, groups).build();
}

}  // namespace clues::app
