// The first look at sides of planes: whatever numbers its intervals stand for, its answer is that of rationals; and it answers nearly always.
#include "fastpath/visibility/points/linear_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fastpath/visibility/points/points.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

// Intervals of all widths around numbers of all sizes, and a number in each: an end, or the middle.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double number(int exponents) {
    const auto exponent = static_cast<int>(random_() % static_cast<std::uint64_t>(2 * exponents + 1)) - exponents;
    return std::ldexp(static_cast<double>(random_() >> 11U) * 0x1p-53 - 0.5, exponent);
  }
  Interval interval(double x) {
    const auto kind = random_() % 4;
    if (kind == 0) return {x};
    if (kind == 1) return {std::nextafter(x, -HUGE_VAL), std::nextafter(x, HUGE_VAL)};
    const double by = std::fabs(number(4)) * std::ldexp(std::fabs(x), kind == 2 ? -40 : -8);
    return {x - by, x + by};
  }
  Vec3<Interval> box(int exponents) {
    return {interval(number(exponents)), interval(number(exponents)), interval(number(exponents))};
  }
  Rational in(const Interval& x) {
    const Rational low(x.inf()), high(x.sup());
    const auto kind = random_() % 3;
    return kind == 0 ? low : kind == 1 ? high : Rational(low / 2 + high / 2);
  }
  Exact3 in(const Vec3<Interval>& b) { return {in(b.x), in(b.y), in(b.z)}; }

 private:
  std::mt19937_64 random_;
};

TEST(LinearForm, IsNeverWrongAndSeldomSilent) {
  const RoundedUp rounded_up;
  Numbers numbers(kSeed);
  int answers = 0, wide = 0, without_bound_wrong = 0;
  constexpr int kCases = 200000;
  for (int i = 0; i < kCases; ++i) {
    const Vec3<Interval> n = numbers.box(20), c = numbers.box(30);
    Vec3<Interval> x = numbers.box(30);
    if (i % 2 == 0) {  // next to the plane: where two coordinates put the third
      const double nx = n.x.inf(), ny = n.y.inf(), nz = n.z.inf();
      const double z = c.z.inf() - (nx * (x.x.inf() - c.x.inf()) + ny * (x.y.inf() - c.y.inf())) / nz;
      if (std::isfinite(z)) x.z = numbers.interval(z);
    }
    const int sign = LinearForm(n, c).sign(Around(x));
    const Exact3 from = numbers.in(c);
    const int exact = sgn(Rational(dot(numbers.in(n), numbers.in(x)-from)));
    if (sign != 0) {
      ASSERT_EQ(sign, exact) << "case " << i;
      ++answers;
    }
    // What the same sum says without a bound.
    const Around m(n), p(x), q(c);
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) value += m.at[k] * (p.at[k] - q.at[k]);
    without_bound_wrong += value != 0 && exact != 0 && (value > 0 ? 1 : -1) != exact;
    wide += sign == 0;
  }
  EXPECT_GT(answers, kCases / 2);
  EXPECT_GT(without_bound_wrong, kCases / 1000);
  EXPECT_GT(wide, kCases / 100);
}

TEST(LinearForm, SaysNothingOfWhatIsInfiniteOrSubnormal) {
  const RoundedUp rounded_up;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Vec3<Interval> zero{Interval(0), Interval(0), Interval(0)}, one{Interval(1), Interval(1), Interval(1)};
  const Vec3<Interval> all{Interval(-kInfinity, kInfinity), Interval(0), Interval(0)},
      far{Interval(1, kInfinity), Interval(0), Interval(0)};
  EXPECT_EQ(LinearForm(one, zero).sign(Around(all)), 0);
  EXPECT_EQ(LinearForm(all, zero).sign(Around(one)), 0);
  EXPECT_EQ(LinearForm(one, all).sign(Around(one)), 0);
  EXPECT_EQ(LinearForm(zero, zero).sign(Around(far)), 0);
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(LinearForm(one, zero).sign(Around({Interval(least), Interval(least), Interval(least)})), 0);
  EXPECT_EQ(LinearForm(one, zero).sign(Around(one)), 1);
  EXPECT_EQ(LinearForm().sign(Around(one)), 0);
}

TEST(LinearForm, SaysNothingWhereADialTurnsFiltersOff) {
  const RoundedUp rounded_up;
  const Vec3<Interval> zero{Interval(0), Interval(0), Interval(0)}, one{Interval(1), Interval(1), Interval(1)};
  const LinearForm form(one, zero);
  ASSERT_EQ(form.sign(Around(one)), 1);
  const exact::TurnedProcessDials turned({.unsure_intervals = true});
  EXPECT_EQ(form.sign(Around(one)), 0);
}

}  // namespace
}  // namespace clues::fastpath
