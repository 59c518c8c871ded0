// The strong components of a directed graph: nodes of which each can be reached from each other.
#pragma once

#include <cstdint>
#include <vector>

namespace clues::exact {

// `arcs[v]`: to which nodes arcs lead from v. The components of more than one node, each ascending, by their first node. O(nodes + arcs).
std::vector<std::vector<std::uint32_t>> circles_of(const std::vector<std::vector<std::uint32_t>>& arcs);

// The nodes from `begin` up to `end`, without that.
struct NodeRange {
  std::uint32_t begin = 0, end = 0;
};
// The same where arcs lead from a node to all nodes of some ranges. O(nodes + ranges * log(nodes)), however long the ranges are.
std::vector<std::vector<std::uint32_t>> circles_of(const std::vector<std::vector<NodeRange>>& arcs);

}  // namespace clues::exact
