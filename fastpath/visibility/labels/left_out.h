// D17: what a limit left out. Wedges at a point x show nothing outside of the closed anti-cone A(x) (D8); so what keeps out of the A(x) of every x whose wedges are not there knows
// all that concerns it. The argument is in one_label.h.
//
// z is in A(x) if x is on a segment from z to a point of V, so in every box that holds z and V. So only what was left out in such a box is asked about.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fastpath/visibility/points/points.h"
#include "fastpath/visibility/scene/box_tree.h"
#include "fastpath/visibility/wedges/apex.h"

namespace clues::fastpath {

// The closed side of a plane to which the normal points at the base, as enclosures.
struct HalfSpace {
  IntervalBox normal, base;
  Interval at(const IntervalBox& x) const { return dot(normal, x - base); }
};

class LeftOut {
 public:
  // Of a plane through `base` the side `sign` (1 or -1).
  struct Side {
    const Plane* plane = nullptr;
    int sign = 1;
    const ExactPoint* base = nullptr;
  };
  // What holds the A(x) of one x, or of all x of a convex set, as the sides around it; none if that is everything.
  using Around = std::vector<Side>;

  // The facets of A(x).
  static Around around(const Apex& apex);

  // `cell`: a box around V.
  explicit LeftOut(const IntervalBox& cell) : cell_(cell) {}

  bool empty() const { return anticones_.empty(); }
  std::size_t size() const { return anticones_.size(); }
  void clear();
  // `at` holds the points x. What is added counts from the next index() on.
  void add(Around around, const IntervalBox& at);
  // Needs RoundedUp in scope, here and below. O(n log n) for n added since the last time.
  void index();

  // Calls found(i) for numbers from `first` (a size at an index()) on, ascending, until found returns true; then true. All numbers i are among these of whose A(x) anything is in the box.
  template <class Found>
  bool any_near(const IntervalBox& box, std::size_t first, const Found& found) const {
    const IntervalBox ways = hull(box, cell_);
    std::vector<std::uint32_t> near;
    for (const Batch& b : batches_) {
      if (b.begin < first) continue;
      near.clear();
      b.tree.any([&](const IntervalBox& at) { return overlap(at, ways); },
                 [&](std::uint32_t i) {
                   near.push_back(i);
                   return false;
                 });
      std::sort(near.begin(), near.end());
      if (std::any_of(near.begin(), near.end(), [&](std::uint32_t i) { return found(b.begin + i); })) return true;
    }
    return false;
  }

  // Whether the hull of what the boxes enclose is surely outside of all; the segment from a to b.
  bool surely_misses(std::span<const IntervalBox> hull) const;
  bool surely_misses(const IntervalBox& a, const IntervalBox& b) const;
  // Whether the segment is surely outside of number `i`; whether x is in it, exactly.
  bool surely_misses(std::size_t i, const IntervalBox& a, const IntervalBox& b) const;
  bool holds(std::size_t i, const ExactPoint& x) const;

 private:
  struct Anticone {
    Around around;
    std::vector<HalfSpace> sides;
  };
  struct Batch {
    std::size_t begin;
    BoxTree tree;
  };
  IntervalBox cell_;
  std::vector<Anticone> anticones_;
  std::vector<IntervalBox> added_;  // where those are that no batch has yet
  std::vector<Batch> batches_;
};

}  // namespace clues::fastpath
