// The first look at which side of a plane something is on: n.(x - c) in plain doubles, with a bound on what that may be off. It answers, or leaves it to intervals and
// exact numbers. Few of the things that are asked about lie next to the plane; all others are told by a dozen products.
#pragma once

#include <array>
#include <cmath>

#include "fastpath/visibility/points/numbers.h"

namespace clues::fastpath {

// What intervals enclose, as a middle and how far it goes on either side.
struct Around {
  std::array<double, 3> at{}, by{};

  // Needs RoundedUp in scope, here and below.
  explicit Around(const Vec3<Interval>& box) {
    const Interval* const side[3] = {&box.x, &box.y, &box.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = side[i]->inf(), high = side[i]->sup();
      at[i] = low == high ? low : low / 2 + high / 2;
      by[i] = std::fmax(high - at[i], at[i] - low);
    }
  }
};

// With n known up to d in a coordinate, c up to r and x up to h the true value is (n + d).(x - c + h - r). It is off from n.(x - c) by |n| (h + r) + d (|x - c| + h + r) at most,
// and a difference, a product and two sums lose less than 2^-49 |n||x - c|, in any rounding mode; where products underflow 2^-1074 each. The rest of 2^-48 is for a difference
// whose size is rounded down. Infinite intervals: no comparison holds. Products must not overflow: finite coordinates are in the standard range.
class LinearForm {
 public:
  LinearForm() = default;
  LinearForm(const Vec3<Interval>& n, const Vec3<Interval>& c) {
    const Around normal(n), center(c);
    n_ = normal.at;
    c_ = center.at;
    slack_ = 0x1p-1060;
    for (std::size_t i = 0; i < 3; ++i) {
      size_[i] = std::fabs(normal.at[i]) + normal.by[i];
      weight_[i] = size_[i] * 0x1p-48 + normal.by[i];
      slack_ += size_[i] * center.by[i];
    }
  }

  // 1: positive for all that x holds, -1: negative for all, 0: not known.
  int sign(const Around& x) const {
    if (exact::process_dials::is_on(exact::process_dials::unsure_intervals)) [[unlikely]]
      return 0;
    double value = 0, bound = slack_;
    for (std::size_t i = 0; i < 3; ++i) {
      const double way = x.at[i] - c_[i];
      value += n_[i] * way;
      bound += size_[i] * x.by[i] + weight_[i] * std::fabs(way);
    }
    return value > bound ? 1 : -value > bound ? -1 : 0;
  }

 private:
  std::array<double, 3> n_{}, c_{}, size_{}, weight_{};
  double slack_ = HUGE_VAL;
};

}  // namespace clues::fastpath
