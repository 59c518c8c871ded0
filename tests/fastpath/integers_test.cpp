// Sums of directions whose sizes are far apart (integers.h), down to the smallest doubles and up to the largest.
#include "fastpath/visibility/points/integers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
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

mpq_class to_rational(const Integer& x) { return mpq_class(x.str()); }

mpq_class power_of_two(int e) {
  mpq_class q = 1;
  (e < 0 ? mpq_div_2exp : mpq_mul_2exp)(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(std::abs(e)));
  return q;
}

// Points on a way and beyond its end, of points of all kinds, of one another too.
TEST(Homogeneous, IsThePointThatRationalsGive) {
  const fastpath::RoundedUp rounded_up;
  using fastpath::ExactPoint;
  std::deque<ExactPoint> points;
  for (const fastpath::Point& p : {fastpath::Point{0, 0, 0}, {0.1, -0.3, 1e17}, {-7, 0x1p-60, 3}, {0x1p-300, 5, -0.7}})
    points.emplace_back(p);
  const fastpath::Plane plane(points[0], points[1], points[3]);
  const std::size_t given = points.size();
  for (std::size_t i = 0; i < given; ++i) {
    for (std::size_t j = 0; j < given; ++j) {
      if (plane.side(points[i]) * plane.side(points[j]) < 0)
        points.push_back(ExactPoint::on_plane(points[i], points[j], plane));
      points.push_back(ExactPoint::reflected(points[i], points[j]));
      for (const double t : {0.0, 1.0, 0.4716796875, 0x1.8p-29, 1 - 0x1p-53, 3.0, -0.1, 0x1p-200, 1e-300})
        points.push_back(ExactPoint::between(points[i], points[j], t));
    }
  }
  const std::size_t simple = points.size();
  ASSERT_GT(simple, 120U);
  for (std::size_t i = 0; i < simple; ++i) {
    const ExactPoint &a = points[i], &b = points[(i * 7 + 3) % simple];
    points.push_back(ExactPoint::reflected(a, b));
    points.push_back(ExactPoint::between(a, b, 0.4716796875));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto whole = points[i].homogeneous();
    const fastpath::Exact3& exact = points[i].exact();
    const mpq_class below = to_rational(whole.w) * power_of_two(whole.e);
    EXPECT_GT(whole.w.sign(), 0) << i;
    EXPECT_EQ(whole.whole, whole.w == 1) << i;
    EXPECT_EQ(to_rational(whole.v.x), mpq_class(exact.x * below)) << i;
    EXPECT_EQ(to_rational(whole.v.y), mpq_class(exact.y * below)) << i;
    EXPECT_EQ(to_rational(whole.v.z), mpq_class(exact.z * below)) << i;
  }
}

}  // namespace
}  // namespace clues
