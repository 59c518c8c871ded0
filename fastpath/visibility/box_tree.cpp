#include "fastpath/visibility/box_tree.h"

#include <utility>

namespace clues::fastpath {

// Flattened: half of the time of a walk is spent here, and whether interval products are inlined must not hang on what else is compiled.
[[gnu::flatten]] bool SegmentTest::operator()(const IntervalBox& box) const {
  if (!overlap(box, box_)) return false;
  const IntervalBox r = box - start_;
  if (may_be_zero(r.x) && may_be_zero(r.y) && may_be_zero(r.z)) return true;
  return may_be_zero(along_.y * r.z - along_.z * r.y) && may_be_zero(along_.z * r.x - along_.x * r.z) &&
         may_be_zero(along_.x * r.y - along_.y * r.x);
}

BoxTree::BoxTree(std::vector<IntervalBox> boxes) : boxes_(std::move(boxes)) {
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  if (count == 0) return;
  std::vector<Keyed> items(count);
  for (std::uint32_t i = 0; i < count; ++i) items[i].item = i;
  nodes_.reserve(count);
  build(items, 0, count);
  for (const Keyed& k : items) items_.push_back(k.item);
}

// By the median, so the depth is below 32.
std::uint32_t BoxTree::build(std::vector<Keyed>& items, std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  IntervalBox box = boxes_[items[begin].item];
  for (std::uint32_t i = begin + 1; i < end; ++i) box = hull(box, boxes_[items[i].item]);
  nodes_[id].box = box;
  if (end - begin <= 2) {
    nodes_[id].first = begin;
    nodes_[id].count = end - begin;
    return id;
  }
  const double size[3] = {box.x.sup() - box.x.inf(), box.y.sup() - box.y.inf(), box.z.sup() - box.z.inf()};
  const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  for (std::uint32_t i = begin; i < end; ++i) {
    const IntervalBox& b = boxes_[items[i].item];
    const Interval& x = axis == 0 ? b.x : axis == 1 ? b.y : b.z;
    items[i].key = x.inf() + x.sup();
  }
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(items.begin() + begin, items.begin() + half, items.begin() + end,
                   [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.item < b.item; });
  const std::uint32_t left = build(items, begin, half), right = build(items, half, end);
  nodes_[id].first = left;
  nodes_[id].second = right;
  return id;
}

}  // namespace clues::fastpath
