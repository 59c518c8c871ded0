// The walk of one segment through the tree. It reaches every block with a triangle that the exact segment meets (before the limit).
#pragma once

#include <array>
#include <cstddef>

#include "fastpath/queries/bvh.h"

namespace clues::fastpath {

// The traversal as a sequence of steps, children in any order, so that the traversals of several segments can
// take turns: while one waits for memory another computes.
class Traversal {
 public:
  explicit Traversal(const LocalSegment& segment) : test_(segment) {}

  // Looks at one node or one block; false when that was the last. leaf(block) returns true to end the walk. The tree is not empty.
  template <class Leaf>
  bool step(const Bvh& bvh, const Leaf& leaf) {
    if ((next_ & BoxLanes::kLeaf) == 0) {
      const BoxLanes& node = bvh.nodes()[next_];
      unsigned met = test_(node, 1.0F, nullptr);
      if (met != 0) {
        next_ = node.child[__builtin_ctz(met)];
        for (met &= met - 1; met != 0; met &= met - 1) stack_[size_++] = node.child[__builtin_ctz(met)];
        return true;
      }
    } else if (leaf(bvh.blocks()[next_ & ~BoxLanes::kLeaf])) {
      return false;
    }
    if (size_ == 0) return false;
    next_ = stack_[--size_];
    return true;
  }

  // Asks for the memory that the next step needs.
  void prefetch(const Bvh& bvh) const {
    const bool leaf = (next_ & BoxLanes::kLeaf) != 0;
    const auto* at = leaf ? reinterpret_cast<const char*>(bvh.blocks().data() + (next_ & ~BoxLanes::kLeaf))
                          : reinterpret_cast<const char*>(bvh.nodes().data() + next_);
    for (std::size_t i = 0; i < (leaf ? sizeof(TriangleBlock) : sizeof(BoxLanes)); i += 64) __builtin_prefetch(at + i);
  }

 private:
  BoxTest test_;
  std::uint32_t next_ = 0;
  std::size_t size_ = 0;
  std::array<std::uint32_t, (BoxLanes::kWidth - 1) * Bvh::kDeepest + 4> stack_;  // NOLINT: filled as it grows
};

template <class Leaf>
void traverse(const Bvh& bvh, const LocalSegment& segment, const Leaf& leaf) {
  if (bvh.nodes().empty()) return;
  Traversal traversal(segment);
  while (traversal.step(bvh, leaf)) {
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
    if (next.near > BoxTest::widened(end)) continue;
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
