// T6: neighbouring cells of a bake in groups. What is hidden from the box around a group is hidden from its cells, so they can be mapped in what the box sees.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/bakes/bake_store.h"

namespace clues::fastpath::bakes {

struct CellGroups {
  std::vector<std::vector<scene::Point>> boxes;  // of each group, its corners; number 0 is no group
  std::vector<std::uint32_t> group_of;           // per cell; 0: it is alone
};

// Cells are halved by the middles of their boxes along the longest side, until a group has at most `most`. O(n log^2 n), the same in every run.
CellGroups groups_of(const std::vector<scene::BakePlace>& cells, std::size_t most);

// Gives a plan that has its cells, and no node but the scene, the nodes of `--group most`. Without groups that are mapped (1), neighbours still help each other with guesses.
void add_groups(scene::BakePlan& plan, std::size_t most);

}  // namespace clues::fastpath::bakes
