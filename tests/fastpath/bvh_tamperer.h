// Plants bugs in a finished tree, so that tests can show that they would be found.
#pragma once

#include <algorithm>

#include "fastpath/queries/bvh.h"

namespace clues::fastpath {

class BvhTamperer {
 public:
  // All error bounds of stage 1 are proportional to the sizes or their squares.
  static void scale_sizes(Bvh& bvh, float factor) {
    for (TriangleBlock& block : bvh.blocks_) {
      for (float& size : block.size) size *= factor;
    }
  }
  // Every box loses `by` at every side.
  static void shrink_boxes(Bvh& bvh, float by) {
    for (BoxLanes& node : bvh.nodes_) {
      for (std::size_t lane = 0; lane < BoxLanes::kWidth; ++lane) {
        for (std::size_t i = 0; i < 3; ++i) {
          node.side[i][lane] += by;
          node.side[i + 3][lane] -= by;
        }
      }
    }
  }
};

}  // namespace clues::fastpath
