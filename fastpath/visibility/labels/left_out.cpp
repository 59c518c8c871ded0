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

void LeftOut::add(Around around) {
  Anticone& anticone = anticones_.emplace_back();
  for (const Side& s : around) {
    const IntervalBox& n = s.plane->normal_approximate();
    anticone.sides.push_back({s.sign > 0 ? n : IntervalBox{-n.x, -n.y, -n.z}, s.base->approximate()});
  }
  anticone.around = std::move(around);
}

bool LeftOut::surely_misses(std::span<const IntervalBox> hull) const {
  return std::all_of(anticones_.begin(), anticones_.end(), [&](const Anticone& anticone) {
    return std::any_of(anticone.sides.begin(), anticone.sides.end(), [&](const HalfSpace& side) {
      return std::all_of(hull.begin(), hull.end(), [&](const IntervalBox& x) { return side.at(x).sup() < 0; });
    });
  });
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
