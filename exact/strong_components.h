// The strong components of a directed graph: nodes of which each can be reached from each other.
#pragma once

#include <cstdint>
#include <vector>

namespace clues::exact {

// `arcs[v]`: to which nodes arcs lead from v. The components of more than one node, each ascending, by their first node. O(nodes + arcs).
std::vector<std::vector<std::uint32_t>> circles_of(const std::vector<std::vector<std::uint32_t>>& arcs);

}  // namespace clues::exact
