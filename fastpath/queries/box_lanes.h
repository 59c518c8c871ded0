// A node of the BVH: eight boxes in floats of the local frame, and what is in them. Boxes contain the exact triangles.
#pragma once

#include <cstdint>

#include "fastpath/predicates/float4.h"
#include "fastpath/queries/local_segment.h"

namespace clues::fastpath {

struct alignas(64) BoxLanes {
  // low x, y, z, high x, y, z; a lane without child has low > high.
  static constexpr std::size_t kWidth = 8;
  alignas(16) float side[6][kWidth];
  std::uint32_t child[kWidth];

  static constexpr std::uint32_t kLeaf = 0x80000000U;   // | number of a triangle block; otherwise the number of a node
  static constexpr std::uint32_t kEmpty = 0xffffffffU;  // no child
  static constexpr float kNowhere = 0x1p80F;            // low sides of empty lanes; high sides are its negative
};

// One segment against many nodes. Never misses a box that the exact segment meets: let the exact segment be in the box at s. The float
// segment is within `reach` there (local_segment.cpp), so for each axis s lies between (near side - near_origin) / along and (far side -
// far_origin) / along in exact arithmetic. Computed, each quotient has three relative errors of u = 2^-24 (a difference, the inverse, a product) and keeps
// its sign: near' <= s (1+u)^3 / (1-u)^3, and far' >= s / the same, that is, both within s (1 +- 4u). A near' below 0 is replaced by 0; far' >= 0.
// So near' <= far' (1 + 9u), and far_inverse is larger by 16u. (Underflow: `reach` has 2^-34 to spare, quotients are at least 2^-2 times that.)
// The limit is a bound on s, and near' may be beyond s by 4u: so it is larger by 16u (less the rounding of
// that product, u), here and wherever a near' is compared with it.
class BoxTest {
 public:
  static float widened(float limit) { return limit * (1 + 0x1p-20F); }

  explicit BoxTest(const LocalSegment& s) {
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      near_side_[i] = s.forward[k] ? i : i + 3;
      far_side_[i] = s.forward[k] ? i + 3 : i;
      near_origin_[i] = all_lanes(s.near_origin[k]);
      far_origin_[i] = all_lanes(s.far_origin[k]);
      inverse_[i] = all_lanes(s.inverse[k]);
      far_inverse_[i] = all_lanes(widened(s.inverse[k]));
    }
  }

  // Bit i: child i may be met at s <= limit (1: anywhere). near: where, for each child.
  unsigned operator()(const BoxLanes& node, float limit, float* near) const {
    const Float4 last = all_lanes(widened(limit));
    unsigned met = 0;
    for (std::size_t lane = 0; lane < BoxLanes::kWidth; lane += 4) {
      const Float4 near_x = (load4(node.side[near_side_[0]] + lane) - near_origin_[0]) * inverse_[0];
      const Float4 near_y = (load4(node.side[near_side_[1]] + lane) - near_origin_[1]) * inverse_[1];
      const Float4 near_z = (load4(node.side[near_side_[2]] + lane) - near_origin_[2]) * inverse_[2];
      const Float4 far_x = (load4(node.side[far_side_[0]] + lane) - far_origin_[0]) * far_inverse_[0];
      const Float4 far_y = (load4(node.side[far_side_[1]] + lane) - far_origin_[1]) * far_inverse_[1];
      const Float4 far_z = (load4(node.side[far_side_[2]] + lane) - far_origin_[2]) * far_inverse_[2];
      const Float4 low = max4(max4(near_x, near_y), max4(near_z, all_lanes(0.0F)));
      const Float4 high = min4(min4(far_x, far_y), min4(far_z, last));
      met |= bits_of(low <= high) << lane;
      if (near != nullptr) store4(near + lane, low);
    }
    return met;
  }

 private:
  int near_side_[3], far_side_[3];
  Float4 near_origin_[3], far_origin_[3], inverse_[3], far_inverse_[3];
};

}  // namespace clues::fastpath
