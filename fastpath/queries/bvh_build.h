// The binned surface-area heuristic: from boxes to a tree. Reachable from tests, not for users.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fastpath/queries/box_lanes.h"

namespace clues::fastpath {

// In floats of the local frame (local_frame.h); empty until something is added.
struct LocalBox {
  std::array<float, 3> low{BoxLanes::kNowhere, BoxLanes::kNowhere, BoxLanes::kNowhere};
  std::array<float, 3> high{-BoxLanes::kNowhere, -BoxLanes::kNowhere, -BoxLanes::kNowhere};

  void add(const LocalBox& other);
  float half_area() const;
};

struct BoxedTriangle {
  LocalBox box;
  std::uint32_t triangle = 0;
};

// Nodes whose leaf children are numbers of leaves; leaf i is the items leaves[i] .. leaves[i] + leaf_sizes[i] (1 to 4) in the order in which `items`
// is left.
struct Tree {
  std::vector<BoxLanes> nodes;
  std::vector<std::uint32_t> leaves;
  std::vector<std::uint8_t> leaf_sizes;
};

// O(n log n). A function of `items` alone: counts and boxes are the same in whatever order threads join them.
Tree build_tree(std::span<BoxedTriangle> items);

}  // namespace clues::fastpath
