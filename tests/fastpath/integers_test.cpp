// Sums of directions whose sizes are far apart (integers.h), down to the smallest doubles and up to the largest.
#include "fastpath/visibility/points/integers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clues {
namespace {

using fastpath::balanced_sum;
using fastpath::Integer;
using fastpath::Interval;
using fastpath::Vec3;

using Limits = std::numeric_limits<double>;

Vec3<Interval> along(double x, double y) { return {Interval(x), Interval(y), Interval(0)}; }

TEST(BalancedSum, OfIntervalsIsBetweenTheTwoWhateverTheirSizes) {
  for (const double a : {Limits::denorm_min(), Limits::min(), 1.0, Limits::max() / 4}) {
    for (const double b : {Limits::denorm_min(), Limits::min(), 1.0, Limits::max() / 4}) {
      const Vec3<Interval> sum = balanced_sum<Interval>(along(a, 0), along(0, b));
      EXPECT_GT(sum.x.inf(), 0) << a << " " << b;
      EXPECT_GT(sum.y.inf(), 0) << a << " " << b;
      EXPECT_TRUE(std::isfinite(sum.x.sup()) && std::isfinite(sum.y.sup())) << a << " " << b;
    }
  }
}

TEST(BalancedSum, OfWholeNumbersLetsNeitherBeNegligible) {
  const Integer small(3), large = Integer(5) << 3000;
  const Vec3<Integer> sum = balanced_sum<Integer>({small, Integer(0), Integer(0)}, {Integer(0), large, Integer(0)});
  EXPECT_GT(sum.x * 4, sum.y);
  EXPECT_LT(sum.x, sum.y * 4);
}

}  // namespace
}  // namespace clues
