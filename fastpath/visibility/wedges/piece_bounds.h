// Where a valid piece (D13) is, in doubles: on its plane, left of the sides of its outline. Rules out nearly all pieces that something does not meet, before any of
// them is asked exactly.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "fastpath/visibility/points/linear_form.h"
#include "fastpath/visibility/wedges/on_wedge.h"

namespace clues::fastpath {

class PieceBounds {
 public:
  // Of the plane with this normal, through `base`. Needs RoundedUp in scope, here and below.
  PieceBounds(const Vec3<Interval>& normal, const ExactPoint& base) : plane_(normal, base.approximate()) {}
  // Of the side from a to b of the outline, counter-clockwise about the same normal; at most four.
  void add_side(const Vec3<Interval>& normal, const ExactPoint& a, const ExactPoint& b) {
    inward_[sides_++] = LinearForm(cross(normal, b.approximate() - a.approximate()), a.approximate());
  }

  // False only if the piece surely has no point in common with the hull of what these hold.
  bool may_touch(std::span<const Around> corners) const {
    const auto all = [&](const LinearForm& form, int sign) {
      return std::all_of(corners.begin(), corners.end(), [&](const Around& x) { return form.sign(x) == sign; });
    };
    const int first = plane_.sign(corners.front());
    if (first != 0 && all(plane_, first)) return false;
    return std::none_of(inward_.begin(), inward_.begin() + sides_, [&](const LinearForm& f) { return all(f, -1); });
  }
  bool may_touch(const Around& box) const { return may_touch({&box, 1}); }

 private:
  LinearForm plane_;
  std::array<LinearForm, 4> inward_;
  std::ptrdiff_t sides_ = 0;
};

}  // namespace clues::fastpath
