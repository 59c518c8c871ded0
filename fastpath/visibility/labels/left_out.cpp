#include "fastpath/visibility/labels/left_out.h"

#include <algorithm>
#include <utility>

namespace clues::fastpath {

LeftOut::Around LeftOut::around(const Apex& apex) {
  Around facets;
  const Plane* last = nullptr;  // the sectors of one facet follow each other
  for (const ApexSector& s : apex.sectors()) {
    if (s.plane != last) facets.push_back({s.plane, 1, apex.x()});
    last = s.plane;
  }
  return facets;
}

void LeftOut::clear() {
  anticones_.clear();
  added_.clear();
  batches_.clear();
}

void LeftOut::add(Around around, const IntervalBox& at) {
  Anticone& anticone = anticones_.emplace_back();
  for (const Side& s : around) {
    const IntervalBox& n = s.plane->normal_approximate();
    anticone.sides.push_back({s.sign > 0 ? n : IntervalBox{-n.x, -n.y, -n.z}, s.base->approximate()});
  }
  anticone.around = std::move(around);
  added_.push_back(at);
}

void LeftOut::index() {
  if (added_.empty()) return;
  const std::size_t begin = size() - added_.size();
  batches_.push_back({begin, BoxTree(std::move(added_))});
  added_.clear();
}

bool LeftOut::surely_misses(std::span<const IntervalBox> hull) const {
  IntervalBox all = hull.front();
  for (const IntervalBox& x : hull) all = fastpath::hull(all, x);
  return !any_near(all, 0, [&](std::size_t i) {
    const std::vector<HalfSpace>& sides = anticones_[i].sides;
    return std::none_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
      return std::all_of(hull.begin(), hull.end(), [&](const IntervalBox& x) { return side.at(x).sup() < 0; });
    });
  });
}

bool LeftOut::surely_misses(const IntervalBox& a, const IntervalBox& b) const {
  return !any_near(hull(a, b), 0, [&](std::size_t i) { return !surely_misses(i, a, b); });
}

// It leaves one side before it enters another.
bool LeftOut::surely_misses(std::size_t i, const IntervalBox& a, const IntervalBox& b) const {
  double enters = 0, leaves = 1;  // at the earliest, at the latest
  for (const HalfSpace& side : anticones_[i].sides) {
    const Interval at_a = side.at(a), at_b = side.at(b);
    if (at_a.sup() < 0 && at_b.sup() < 0) return true;
    if (at_a.sup() < 0 && at_b.inf() > 0) enters = std::max(enters, (at_a / (at_a - at_b)).inf());
    if (at_a.inf() > 0 && at_b.sup() < 0) leaves = std::min(leaves, (at_a / (at_a - at_b)).sup());
  }
  return enters > leaves;
}

bool LeftOut::holds(std::size_t i, const ExactPoint& x) const {
  const Around& around = anticones_[i].around;
  return std::all_of(around.begin(), around.end(), [&](const Side& s) { return s.sign * s.plane->side(x) >= 0; });
}

}  // namespace clues::fastpath
