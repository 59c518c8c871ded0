// A small tree over boxes for the pieces of a local scene and for wedge pieces. A box is three intervals, so a test is an interval expression
// over the box: it excludes what it surely excludes, and no rounding can make it miss.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "fastpath/visibility/points/points.h"

namespace clues::fastpath {

using IntervalBox = Vec3<Interval>;

inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}
inline IntervalBox hull(const IntervalBox& a, const IntervalBox& b) {
  return {hull(a.x, b.x), hull(a.y, b.y), hull(a.z, b.z)};
}
inline bool may_be_zero(const Interval& x) { return x.inf() <= 0 && x.sup() >= 0; }
inline bool overlap(const Interval& a, const Interval& b) { return a.inf() <= b.sup() && b.inf() <= a.sup(); }
inline bool overlap(const IntervalBox& a, const IntervalBox& b) {
  return overlap(a.x, b.x) && overlap(a.y, b.y) && overlap(a.z, b.z);
}

// Whether a segment may meet a box.
class SegmentTest {
 public:
  SegmentTest(const ExactPoint& a, const ExactPoint& b)
      : start_(a.approximate()),
        along_(b.approximate() - a.approximate()),
        box_(hull(a.approximate(), b.approximate())) {}
  bool operator()(const IntervalBox& box) const;

 private:
  IntervalBox start_, along_, box_;
};

class BoxTree {
 public:
  BoxTree() = default;
  // Items are numbered as the boxes are. O(n log n).
  explicit BoxTree(std::vector<IntervalBox> boxes);

  std::size_t size() const { return items_.size(); }

  // Calls found(item) for every item whose box passes the test, until found returns true; then true.
  template <class Test, class Found>
  bool any(const Test& test, const Found& found) const {
    if (nodes_.empty()) return false;
    std::uint32_t stack[96];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!test(node.box)) continue;
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          if ((node.count == 1 || test(boxes_[items_[i]])) && found(items_[i])) return true;
        }
      } else {
        stack[size++] = node.first;
        stack[size++] = node.second;
      }
    }
    return false;
  }

 private:
  struct Node {
    IntervalBox box;
    std::uint32_t first = 0, second = 0;  // children; of a leaf: its first item
    std::uint32_t count = 0;
  };

  struct Item {
    std::array<double, 3> middle;  // of its box, times two
    std::uint32_t id;
  };
  std::uint32_t build(std::vector<Item>& items, std::uint32_t begin, std::uint32_t end);

  std::vector<IntervalBox> boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace clues::fastpath
