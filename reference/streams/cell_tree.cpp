#include "reference/streams/cell_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "scene/mesh/halved.h"

namespace clues::reference {
namespace {

class TreeBuilder {
 public:
  TreeBuilder(const std::vector<std::vector<scene::Point>>& cells, std::size_t levels) : next_(levels + 1, 0) {
    for (const auto& corners : cells) bounds_.push_back(scene::bounds_of(corners));
    tree_.node_of.assign(levels + 1, std::vector<std::uint32_t>(cells.size()));
  }

  CellTree build() {
    std::vector<std::uint32_t> all(bounds_.size());
    std::iota(all.begin(), all.end(), 0U);
    if (!all.empty()) split(all, tree_.node_of.size());
    return std::move(tree_);
  }

 private:
  // Of all these cells; levels from `named` on have a node that holds them already.
  void split(std::span<std::uint32_t> cells, std::size_t named) {
    while (named > 0 && cells.size() <= (std::size_t{1} << (named - 1))) {
      --named;
      for (const std::uint32_t c : cells) tree_.node_of[named][c] = next_[named];
      ++next_[named];
    }
    if (cells.size() == 1) return;
    const std::size_t half = scene::halve(cells, bounds_);
    split(cells.first(half), named);
    split(cells.subspan(half), named);
  }

  std::vector<scene::Bounds> bounds_;
  std::vector<std::uint32_t> next_;  // of each level, the number of its next node
  CellTree tree_;
};

}  // namespace

CellTree cell_tree(const std::vector<std::vector<scene::Point>>& cells, std::size_t levels) {
  return TreeBuilder(cells, levels).build();
}

CellTree cell_tree(const std::vector<scene::CellSpec>& cells, std::size_t levels) {
  std::vector<std::vector<scene::Point>> corners;
  for (const auto& cell : cells) corners.push_back(cell.points);
  return cell_tree(corners, levels);
}

std::vector<std::vector<std::uint32_t>> lists_of_nodes(const std::vector<std::uint32_t>& node_of,
                                                       const std::vector<std::vector<std::uint32_t>>& lists) {
  std::vector<std::vector<std::uint32_t>> out;
  for (std::size_t c = 0; c < lists.size(); ++c) {
    if (node_of[c] >= out.size()) out.resize(node_of[c] + 1);
    out[node_of[c]].insert(out[node_of[c]].end(), lists[c].begin(), lists[c].end());
  }
  for (auto& list : out) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return out;
}

}  // namespace clues::reference
