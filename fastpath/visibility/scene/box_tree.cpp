#include "fastpath/visibility/scene/box_tree.h"

#include <utility>

#include "exact/dials.h"

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
  std::vector<Item> items;
  items.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const IntervalBox& b = boxes_[i];
    items.push_back({{b.x.inf() + b.x.sup(), b.y.inf() + b.y.sup(), b.z.inf() + b.z.sup()}, i});
  }
  nodes_.reserve(count);
  build(items, 0, count);
  for (const Item& item : items) items_.push_back(item.id);
}

// At half of the way on the axis on which the middles spread most, or by their median where that leaves less than a quarter on one side: so the depth is below 80.
std::uint32_t BoxTree::build(std::vector<Item>& items, std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin <= 2 || exact::process_dials::is_on(exact::process_dials::flat_trees)) {
    IntervalBox box = boxes_[items[begin].id];
    for (std::uint32_t i = begin + 1; i < end; ++i) box = hull(box, boxes_[items[i].id]);
    nodes_[id].box = box;
    nodes_[id].first = begin;
    nodes_[id].count = end - begin;
    return id;
  }
  std::array<double, 3> low = items[begin].middle, high = low;
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], items[i].middle[k]);
      high[k] = std::max(high[k], items[i].middle[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  }
  const auto first = items.begin() + begin, last = items.begin() + end;
  const double border = low[axis] / 2 + high[axis] / 2;
  auto half = std::partition(first, last, [&](const Item& item) { return item.middle[axis] < border; });
  if (4 * std::min(half - first, last - half) < last - first) {
    half = first + (last - first) / 2;
    std::nth_element(first, half, last, [axis](const Item& a, const Item& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.id < b.id;
    });
  }
  const auto middle = static_cast<std::uint32_t>(half - items.begin());
  const std::uint32_t left = build(items, begin, middle), right = build(items, middle, end);
  nodes_[id].box = hull(nodes_[left].box, nodes_[right].box);
  nodes_[id].first = left;
  nodes_[id].second = right;
  return id;
}

}  // namespace clues::fastpath
