// The walk of one segment through the tree. It reaches every block with a triangle that the exact segment meets (before the limit).
#pragma once

#include <array>
#include <cstddef>

#include "fastpath/bvh.h"

namespace clues::fastpath {

// leaf(block) returns true to end the walk. Children in any order.
template <class Leaf>
void traverse(const Bvh& bvh, const LocalSegment& segment, const Leaf& leaf) {
  if (bvh.nodes().empty()) return;
  const BoxLanes* const nodes = bvh.nodes().data();
  const TriangleBlock* const blocks = bvh.blocks().data();
  const BoxTest test(segment);
  std::array<std::uint32_t, (BoxLanes::kWidth - 1) * Bvh::kDeepest + 4> stack;  // NOLINT: filled as it grows
  std::size_t size = 0;
  std::uint32_t next = 0;
  for (;;) {
    if ((next & BoxLanes::kLeaf) == 0) {
      const BoxLanes& node = nodes[next];
      unsigned met = test(node, 1.0F, nullptr);
      if (met != 0) {
        next = node.child[__builtin_ctz(met)];
        for (met &= met - 1; met != 0; met &= met - 1) stack[size++] = node.child[__builtin_ctz(met)];
        continue;
      }
    } else if (leaf(blocks[next & ~BoxLanes::kLeaf])) {
      return;
    }
    if (size == 0) return;
    next = stack[--size];
  }
}

// Nearer children first, and none that begins behind `limit()`, a parameter of the local segment which may shrink.
template <class Leaf, class Limit>
void traverse_ordered(const Bvh& bvh, const LocalSegment& segment, const Leaf& leaf, const Limit& limit) {
  if (bvh.nodes().empty()) return;
  const BoxTest test(segment);
  struct Waiting {
    float near;
    std::uint32_t child;
  };
  std::array<Waiting, (BoxLanes::kWidth - 1) * Bvh::kDeepest + 4> stack;  // NOLINT: filled as it grows
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const Waiting next = stack[--size];
    const float end = limit();
    if (next.near > end * (1 + 0x1p-20F)) continue;
    if ((next.child & BoxLanes::kLeaf) != 0) {
      leaf(bvh.blocks()[next.child & ~BoxLanes::kLeaf]);
      continue;
    }
    const BoxLanes& node = bvh.nodes()[next.child];
    std::array<float, BoxLanes::kWidth> near;  // NOLINT: filled by the test
    const std::size_t first = size;
    for (unsigned met = test(node, end, near.data()); met != 0; met &= met - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(met));
      const Waiting child{near[lane], node.child[lane]};
      std::size_t at = size++;
      for (; at > first && stack[at - 1].near < child.near; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
}

}  // namespace clues::fastpath
