// A small tree over boxes for the pieces of a local scene and for wedge pieces. A box is three intervals, so a test is an interval expression
// over the box: it excludes what it surely excludes, and no rounding can make it miss.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fastpath/visibility/points.h"

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
  bool operator()(const IntervalBox& box) const {
    if (!overlap(box, box_)) return false;
    const IntervalBox r = box - start_;
    return may_be_zero(along_.y * r.z - along_.z * r.y) && may_be_zero(along_.z * r.x - along_.x * r.z) &&
           may_be_zero(along_.x * r.y - along_.y * r.x);
  }

 private:
  IntervalBox start_, along_, box_;
};

class BoxTree {
 public:
  BoxTree() = default;
  // Items are numbered as the boxes are. O(n log n).
  explicit BoxTree(const std::vector<IntervalBox>& boxes) : boxes_(boxes) {
    items_.resize(boxes.size());
    for (std::uint32_t i = 0; i < items_.size(); ++i) items_[i] = i;
    if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
  }

  std::size_t size() const { return items_.size(); }

  // Calls found(item) for every item whose box passes the test, until found returns true; then true.
  template <class Test, class Found>
  bool any(const Test& test, const Found& found) const {
    if (nodes_.empty()) return false;
    std::uint32_t stack[64];
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

  // By the median, so the depth is below 32.
  std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    IntervalBox box = boxes_[items_[begin]];
    for (std::uint32_t i = begin + 1; i < end; ++i) box = hull(box, boxes_[items_[i]]);
    nodes_[id].box = box;
    if (end - begin <= 2) {
      nodes_[id].first = begin;
      nodes_[id].count = end - begin;
      return id;
    }
    const double size[3] = {box.x.sup() - box.x.inf(), box.y.sup() - box.y.inf(), box.z.sup() - box.z.inf()};
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    const auto middle = [&](std::uint32_t i) {
      const IntervalBox& b = boxes_[i];
      const Interval& x = axis == 0 ? b.x : axis == 1 ? b.y : b.z;
      return x.inf() + x.sup();
    };
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + begin, items_.begin() + half, items_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = middle(a), y = middle(b);
                       return x != y ? x < y : a < b;
                     });
    const std::uint32_t left = build(begin, half), right = build(half, end);
    nodes_[id].first = left;
    nodes_[id].second = right;
    return id;
  }

  std::vector<IntervalBox> boxes_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace clues::fastpath
