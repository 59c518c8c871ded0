// A static tree of axis-aligned boxes over any items, for culling only: it may propose too much, never too little.
// Boxes are doubles that contain the exact geometry (CGAL's bbox() rounds outward). Tests against boxes run in interval
// arithmetic, so a box is skipped only when the exact geometry certainly misses it.
#pragma once

#include <CGAL/Bbox_3.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "exact/dials.h"
#include "exact/kernel.h"

namespace clues::exact {

using Interval = CGAL::Interval_nt<false>;

// True unless the closed segment (a,b) certainly misses the box. Separating axes: x, y, z and the three cross products of
// the segment with them. It can be made with any rounding; to ask it needs the rounding mode set by BoxTree::visit.
class SegmentBoxTest {
 public:
  SegmentBoxTest(const Point3& a, const Point3& b) : box_(a.bbox() + b.bbox()) {
    const CGAL::Protect_FPU_rounding<true> rounded_up;
    for (int i = 0; i < 3; ++i) {
      a_[i] = Interval(CGAL::to_interval(a[i]));
      d_[i] = Interval(CGAL::to_interval(b[i])) - a_[i];
    }
  }
  bool operator()(const CGAL::Bbox_3& box) const {
    if (process_dials::is_on(process_dials::unsure_intervals)) return true;
    if (!CGAL::do_overlap(box_, box)) return false;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      // d x (corner - a) over the box is an interval; it must be able to vanish.
      const Interval u = Interval(box.min(i), box.max(i)) - a_[i];
      const Interval w = Interval(box.min(j), box.max(j)) - a_[j];
      const Interval cross = d_[i] * w - d_[j] * u;
      if (cross.inf() > 0 || cross.sup() < 0) return false;
    }
    return true;
  }

 private:
  CGAL::Bbox_3 box_;
  Interval a_[3], d_[3];
};

// True unless the plane certainly misses the box.
class PlaneBoxTest {
 public:
  explicit PlaneBoxTest(const Plane3& h)
      : n_{Interval(CGAL::to_interval(h.a())), Interval(CGAL::to_interval(h.b())), Interval(CGAL::to_interval(h.c()))},
        d_(CGAL::to_interval(h.d())) {}
  // The interval of the plane's value over the box.
  Interval value(const CGAL::Bbox_3& box) const {
    return n_[0] * Interval(box.xmin(), box.xmax()) + n_[1] * Interval(box.ymin(), box.ymax()) +
           n_[2] * Interval(box.zmin(), box.zmax()) + d_;
  }
  bool operator()(const CGAL::Bbox_3& box) const {
    const Interval v = value(box);
    return (v.inf() <= 0 && v.sup() >= 0) || process_dials::is_on(process_dials::unsure_intervals);
  }
  bool may_be_positive(const CGAL::Bbox_3& box) const {
    return value(box).sup() >= 0 || process_dials::is_on(process_dials::unsure_intervals);
  }

 private:
  Interval n_[3], d_;
};

class BoxTree {
 public:
  BoxTree() = default;
  // O(n log n); items keep their indices.
  explicit BoxTree(std::vector<CGAL::Bbox_3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
  }

  // The items whose boxes pass the test, ascending. `may_meet(box)` must be monotone: false for a box implies false for every
  // box inside it.
  template <class Test>
  std::vector<std::uint32_t> candidates(const Test& may_meet) const {
    std::vector<std::uint32_t> found;
    if (nodes_.empty()) return found;
    {
      const CGAL::Protect_FPU_rounding<true> interval_rounding;
      visit(0, may_meet, found);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  struct Node {
    CGAL::Bbox_3 box;
    std::uint32_t begin = 0, end = 0, right = 0;  // right == 0: a leaf; the left child follows its parent
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    CGAL::Bbox_3 box;
    for (std::uint32_t i = begin; i < end; ++i) box += boxes_[order_[i]];
    nodes_[id].box = box;
    nodes_[id].begin = begin;
    nodes_[id].end = end;
    if (end - begin <= kLeafSize || process_dials::is_on(process_dials::flat_trees)) return id;
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (box.max(i) - box.min(i) > box.max(axis) - box.min(axis)) axis = i;
    }
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) { return boxes_[i].min(axis) + boxes_[i].max(axis); };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) { return std::pair(key(i), i) < std::pair(key(j), j); });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[id].right = right;
    return id;
  }

  template <class Test>
  void visit(std::uint32_t id, const Test& may_meet, std::vector<std::uint32_t>& found) const {
    const Node& node = nodes_[id];
    if (!may_meet(node.box)) return;
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        if (may_meet(boxes_[order_[i]])) found.push_back(order_[i]);
      }
      return;
    }
    visit(id + 1, may_meet, found);
    visit(node.right, may_meet, found);
  }

  std::vector<CGAL::Bbox_3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace clues::exact
