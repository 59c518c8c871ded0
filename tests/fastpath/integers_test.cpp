// Sums of directions whose sizes are far apart (integers.h), down to the smallest doubles and up to the largest.
#include "fastpath/visibility/points/integers.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(AroundMultiple, OneMultipleIsInAllThreeIntervals) {
  for (const unsigned shift : {0U, 1U, 20U, 100U, 700U}) {
    const Integer x = ((Integer(1) << 52) + 1) << shift, y = -(Integer(3) << shift) - 1, z = x / 7;
    for (const Vec3<Integer>& v :
         {Vec3<Integer>{x, y, z}, {z, x, y}, {Integer(0), y, z}, {x, Integer(0), Integer(0)}}) {
      const Vec3<Interval> about = fastpath::around_multiple(v);
      mpq_class least = 0, most = -1;  // multiples that all of them hold; -1: any
      const auto take = [&](const Integer& c, const Interval& in) {
        if (c.sign() == 0) {
          EXPECT_TRUE(in.inf() == 0 && in.sup() == 0) << shift;
          return;
        }
        const mpq_class exact(c.str());
        const mpq_class a = mpq_class(in.inf()) / exact, b = mpq_class(in.sup()) / exact;
        least = std::max(least, std::min(a, b));
        most = most < 0 ? std::max(a, b) : std::min(most, std::max(a, b));
      };
      take(v.x, about.x);
      take(v.y, about.y);
      take(v.z, about.z);
      EXPECT_TRUE(least <= most && most > 0) << shift;
    }
  }
}

}  // namespace
}  // namespace clues
