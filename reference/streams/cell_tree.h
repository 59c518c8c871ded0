// FIGS. 42, 52, 54: a hierarchy above the cells of a stream. Cells are halved by the middles of their boxes, across the
// longest side of the box around them, again and again; so neighbours share nodes, and in a grid nodes are blocks.
//
// A viewer in a node is in one of its cells. So what the node needs is what its cells list together, and not what a map
// of its hull would: that is as much, or more (T6).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/cell_spec.h"
#include "scene/mesh/mesh.h"

namespace clues::reference {

struct CellTree {
  // Of each level its nodes, numbered from 0: which of them each cell is in. On level k a node has at most 2^k cells,
  // on level 0 one. Each node lies in one of the level above. Empty: there is no hierarchy.
  std::vector<std::vector<std::uint32_t>> node_of;
};

// `cells`: the corners of each. Levels 0 to `levels`. O(n log^2 n), the same in every run.
CellTree cell_tree(const std::vector<std::vector<scene::Point>>& cells, std::size_t levels);
CellTree cell_tree(const std::vector<scene::CellSpec>& cells, std::size_t levels);

// What the cells of each node list together, ascending. O(size of the lists * log).
std::vector<std::vector<std::uint32_t>> lists_of_nodes(const std::vector<std::uint32_t>& node_of,
                                                       const std::vector<std::vector<std::uint32_t>>& lists);

}  // namespace clues::reference
