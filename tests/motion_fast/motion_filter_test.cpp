// The filters of the motion predicates: constants recomputed, answers against exact arithmetic.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fastpath/motion/bounds/predicates.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

using namespace fastpath::motion;

const mpq_class u(0x1p-53);

mpq_class power(const mpq_class& x, int n) {
  mpq_class out = 1;
  for (int i = 0; i < n; ++i) out *= x;
  return out;
}

// 2 / sqrt(3) from above: 1.1547005383793 squared is above 4/3.
const mpq_class permanent_of_three("11547005383793/10000000000000");

TEST(MotionFilters, ConstantsAreAsDerived) {
  EXPECT_GT(permanent_of_three * permanent_of_three, mpq_class(4, 3));
  const mpq_class one(1);
  const mpq_class three = (power(1 + u, 8) - 1) * permanent_of_three / (power(1 - 4 * u, 3) * power(1 - u, 3));
  EXPECT_GE(mpq_class(kDeterminantError), three);
  EXPECT_LT(mpq_class(kDeterminantError), three * mpq_class(102, 100));
  const mpq_class four = (power(1 + u, 17) - 1) * 4 * permanent_of_three / (power(1 - 4 * u, 4) * power(1 - u, 4));
  EXPECT_GE(mpq_class(kDelaunayError), four);
  EXPECT_LT(mpq_class(kDelaunayError), four * mpq_class(102, 100));
  const mpq_class lengths = power(1 - 4 * u, 2) * power(1 - u, 4);
  const mpq_class cross = ((power(1 + u, 4) - 1) * permanent_of_three + mpq_class(26, 10) * u) / lengths;
  EXPECT_GE(mpq_class(kCrossError), cross);
  EXPECT_GE(mpq_class(kEdgeErrorOfKappa), (cross + 2 * u) * (1 + 4 * u) / lengths);
  EXPECT_GE(mpq_class(kEdgeError), ((power(1 + u, 5) - 1) + u) * (1 + 4 * u) / lengths);
}

// Within an angle; cocircular about an axis for some, by integers, and moved by units in the last place.
std::array<DepthSample, 4> samples_of(fuzz::Random& random) {
  std::array<DepthSample, 4> s;
  const double angle = std::ldexp(1, -random.between(1, 20));
  const bool cocircular = random.one_in(4);
  constexpr std::array<std::array<double, 2>, 4> circle{{{3, 4}, {-4, 3}, {-3, -4}, {5, 0}}};
  for (std::size_t k = 0; k < 4; ++k) {
    if (cocircular) {
      s[k].at = {circle[k][0] * angle, circle[k][1] * angle, 1};
      const double far = random.between(1, 4);
      for (double& x : s[k].at) x *= far;
      if (random.one_in(4)) s[k].at[0] = std::nextafter(s[k].at[0], 10.0);
    } else {
      const MotionPoint off = direction(random);
      s[k].at = {angle * off[0], angle * off[1], 1 + angle * off[2]};
    }
    s[k].is_direction = random.one_in(5);
  }
  return s;
}

TEST(MotionFilters, NeverContradictExactArithmetic) {
  fuzz::Random random(4);
  const MotionPoint at{0, 0, 0};
  int sure = 0, unsure = 0, zeros = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto s = samples_of(random);
    std::array<Row, 4> r;
    std::array<exact::SightRow, 4> e;
    for (std::size_t i = 0; i < 4; ++i) {
      r[i] = row_of(s[i], at);
      e[i] = exact::sight_row(s[i], at);
    }
    const auto agrees = [&](Answer answer, int sign) {
      ++(answer == Answer::unsure ? unsure : sure);
      zeros += sign == 0;
      return answer == Answer::unsure || (answer == Answer::yes ? sign > 0 : sign < 0);
    };
    ASSERT_TRUE(agrees(faces_filtered(r[0], r[1], r[2]), exact::facing_sign(e[0], e[1], e[2]))) << k;
    ASSERT_TRUE(agrees(delaunay_filtered(r[0], r[1], r[2], r[3]), exact::delaunay_sign(e[0], e[1], e[2], e[3]))) << k;
    MotionThresholds thresholds;
    thresholds.kappa = std::ldexp(1, random.between(-2, 20));
    thresholds.sigma = std::ldexp(1, -random.between(2, 44));
    const exact::ExactThresholds limits(thresholds);
    ASSERT_TRUE(agrees(edge_length_filtered(r[0], r[1], thresholds.kappa),
                       exact::edge_length_holds(e[0], e[1], limits) ? 1 : -1))
        << k;
    const double sine = std::sqrt(thresholds.sigma) * (1 + 0x1p-50);
    if (separation_filtered(r[0], r[1], r[2], sine) == Answer::yes) {
      ASSERT_TRUE(exact::separation_holds(e[0], e[1], e[2], limits)) << k;
    }
  }
  EXPECT_GT(sure, 40000);
  EXPECT_GT(unsure, 1000);
  EXPECT_GT(zeros, 1000);
}

// With a thousandth of the error bound some answer is wrong: the tests above can fail.
TEST(MotionFilters, ATooSmallErrorIsFoundOut) {
  fuzz::Random random(5);
  int wrong = 0;
  for (int k = 0; k < 20000 && wrong == 0; ++k) {
    const auto s = samples_of(random);
    std::array<Row, 4> r;
    std::array<exact::SightRow, 4> e;
    for (std::size_t i = 0; i < 4; ++i) {
      r[i] = row_of(s[i], {0, 0, 0});
      e[i] = exact::sight_row(s[i], MotionPoint{0, 0, 0});
    }
    const Answer answer = delaunay_filtered(r[0], r[1], r[2], r[3], kDelaunayError / 1000);
    if (answer != Answer::unsure)
      wrong += exact::delaunay_sign(e[0], e[1], e[2], e[3]) != (answer == Answer::yes ? 1 : -1);
  }
  EXPECT_GT(wrong, 0);
}

}  // namespace
}  // namespace clues::tests
