// T6: a tree over the cells of a bake. The cell of a node is the box of all cells below it, so what is hidden from a node is hidden from them, and they are mapped in what the
// node sees.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/cell_spec.h"

namespace clues::app {

struct CellTree {
  static constexpr std::uint32_t kRoot = 0;  // never mapped: it sees the scene

  struct Node {
    std::uint32_t parent = kRoot;
    std::vector<scene::Point> box;            // its corners
    std::vector<std::uint32_t> nodes, cells;  // below it, directly; ascending
  };
  std::vector<Node> nodes;             // parents first
  std::vector<std::uint32_t> node_of;  // per cell: what it is mapped in
};

// Cells are halved by the middles of their boxes along the longest side, until a group is small; `groups` are the sizes of groups that become nodes, descending. None:
// each cell is mapped in the scene. O(n log^2 n), the same in every run.
CellTree tree_over(const std::vector<scene::CellSpec>& cells, const std::vector<std::size_t>& groups);

}  // namespace clues::app
