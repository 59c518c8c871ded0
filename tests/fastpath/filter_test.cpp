// Stage 2: the constant of the filter recomputed, its answers against exact ones, and what a smaller constant would do.
#include "fastpath/predicates/filter.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fastpath/predicates/exact_segment.h"
#include "oracle.h"
#include "scene/messages/error.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

Sign exact_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  using exact::to_exact;
  return static_cast<Sign>(static_cast<int>(CGAL::orientation(to_exact(a), to_exact(b), to_exact(c), to_exact(d))));
}

mpq_class exact_determinant(const Point& a, const Point& b, const Point& c, const Point& d) {
  mpq_class m[3][3];
  const Point* rows[] = {&b, &c, &d};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = mpq_class((*rows[i])[k]) - mpq_class(a[k]);
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Four points of a plane, each coordinate a unit or two in the last place off.
std::array<Point, 4> nearly_coplanar(fuzz::Random& random, double offset) {
  std::array<Point, 4> p{};
  for (int i = 0; i < 3; ++i) {
    for (double& x : p[static_cast<std::size_t>(i)]) x = offset + random_double(random);
  }
  const double u = random_double(random), v = random_double(random);
  for (std::size_t k = 0; k < 3; ++k) {
    p[3][k] = stepped(p[0][k] + u * (p[1][k] - p[0][k]) + v * (p[2][k] - p[0][k]), random.between(-2, 2));
  }
  return p;
}

struct Tally {
  int wrong = 0, certain = 0, unsure = 0, beyond = 0;  // beyond: further from the exact value than the bound
  double largest = 0;                                  // error / bound
};

Tally try_out(double error, int rounds) {
  fuzz::Random random(kSeed);
  Tally tally;
  for (int i = 0; i < rounds; ++i) {
    const auto p = nearly_coplanar(random, i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 1e7);
    const Filtered value = orient3d_value(p[0], p[1], p[2], p[3], error);
    const FilteredSign sign = value.sign();
    ++(sign.certain ? tally.certain : tally.unsure);
    tally.wrong += sign.certain && sign.sign != exact_sign(p[0], p[1], p[2], p[3]) ? 1 : 0;
    const mpq_class off = abs(mpq_class(value.value) - exact_determinant(p[0], p[1], p[2], p[3]));
    tally.beyond += off > mpq_class(value.bound) ? 1 : 0;
    if (value.bound > 0) tally.largest = std::max(tally.largest, off.get_d() / value.bound);
  }
  return tally;
}

TEST(Filter, TheConstantIsTheDerivedOneRoundedUp) {
  const mpq_class u(0x1p-53);
  mpq_class up(1), down(1);
  for (int i = 0; i < 8; ++i) up *= 1 + u;
  for (int i = 0; i < 9; ++i) down *= 1 - u;
  const mpq_class derived = (up - 1) / down;
  EXPECT_GE(mpq_class(kOrient3dError), derived);
  EXPECT_LT(mpq_class(std::nextafter(kOrient3dError, 0.0)), derived);
}

TEST(Filter, CertainSignsAreRightNearPlanes) {
  const Tally tally = try_out(kOrient3dError, 30000);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.beyond, 0);
  EXPECT_GT(tally.certain, 1000);
  EXPECT_GT(tally.unsure, 1000);
  EXPECT_GT(tally.largest, 0.05);  // the bound is no wild guess
}

TEST(Filter, TooSmallAConstantIsCaught) {
  const Tally tally = try_out(kOrient3dError / 64, 30000);
  EXPECT_GT(tally.beyond, 0);
  EXPECT_GT(tally.wrong, 0);
}

TEST(Filter, RandomPointsSeldomNeedMore) {
  fuzz::Random random(kSeed);
  int unsure = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<Point, 4> p{};
    for (Point& q : p) {
      for (double& x : q) x = random_double(random);
    }
    const FilteredSign sign = orient3d_filtered(p[0], p[1], p[2], p[3]);
    if (sign.certain) {
      ASSERT_EQ(sign.sign, exact_sign(p[0], p[1], p[2], p[3]));
    } else {
      ++unsure;
    }
  }
  EXPECT_LE(unsure, 2);
}

TEST(Filter, PermutationsAgree) {
  fuzz::Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const auto p = nearly_coplanar(random, 1);
    const FilteredSign even = orient3d_filtered(p[0], p[1], p[2], p[3]),
                       odd = orient3d_filtered(p[1], p[0], p[2], p[3]),
                       again = orient3d_filtered(p[1], p[2], p[0], p[3]);
    if (even.certain && odd.certain) {
      EXPECT_EQ(static_cast<int>(even.sign), -static_cast<int>(odd.sign));
    }
    if (even.certain && again.certain) {
      EXPECT_EQ(even.sign, again.sign);
    }
  }
}

// Points of an axis-aligned plane are the usual case: no exact arithmetic for them.
TEST(Filter, ZeroIsCertainInAxisAlignedPlanes) {
  fuzz::Random random(kSeed);
  for (int i = 0; i < 300; ++i) {
    std::array<Point, 4> p{};
    const double level = random_double(random);
    for (Point& q : p) {
      for (double& x : q) x = random_double(random);
      q[static_cast<std::size_t>(i) % 3] = level;
    }
    const FilteredSign sign = orient3d_filtered(p[0], p[1], p[2], p[3]);
    EXPECT_TRUE(sign.certain);
    EXPECT_EQ(sign.sign, Sign::zero);
  }
}

// Where products underflow or overflow the filter says that it does not know.
TEST(Filter, EveryScaleIsRightOrUnsure) {
  fuzz::Random random(kSeed);
  int certain_near_one = 0, certain_far = 0;
  for (int power = -1074; power <= 1022; power += 6) {
    for (int i = 0; i < 6; ++i) {
      auto p = nearly_coplanar(random, 0);
      if (i % 2 == 0) p[3][0] += 0.5;
      for (Point& q : p) {
        for (double& x : q) x = std::ldexp(x, power);
      }
      const FilteredSign sign = orient3d_filtered(p[0], p[1], p[2], p[3]);
      if (!sign.certain) continue;
      ASSERT_EQ(sign.sign, exact_sign(p[0], p[1], p[2], p[3])) << "2^" << power;
      ++(std::abs(power) < 240 ? certain_near_one : certain_far);
    }
  }
  EXPECT_GT(certain_near_one, 100);
  const Point huge{1e308, 0, 0}, other{-1e308, 1, 0}, third{0, 1e308, 1}, origin{};
  EXPECT_FALSE(orient3d_filtered(huge, other, third, origin).certain);
  EXPECT_FALSE(orient3d_filtered({0x1p-1074, 0, 0}, {0, 1, 0}, {0, 0, 1}, origin).certain);
}

TEST(Filter, TheCrossingParameterIsInItsInterval) {
  fuzz::Random random(kSeed);
  int narrow = 0;
  for (int i = 0; i < 5000; ++i) {
    Corners t{};
    Segment s;
    for (Point* q : {&t[0], &t[1], &t[2], &s.a, &s.b}) {
      for (double& x : *q) x = random_double(random);
    }
    if (i % 2 == 0) {
      for (std::size_t k = 0; k < 3; ++k) s.a[k] = t[0][k] + (t[1][k] - t[0][k]) * 0.3 + 1e-13 * random_double(random);
    }
    const Range range = crossing_parameter(s, t);
    const mpq_class at_a = exact_determinant(t[0], t[1], t[2], s.a), at_b = exact_determinant(t[0], t[1], t[2], s.b);
    if (sgn(at_a) * sgn(at_b) >= 0) continue;
    const mpq_class where = at_a / (at_a - at_b);
    ASSERT_LE(mpq_class(range.low), where);
    ASSERT_GE(mpq_class(range.high), where);
    narrow += range.high - range.low < 1e-12 ? 1 : 0;
  }
  EXPECT_GT(narrow, 500);
}

// Multiples of 0.1 as a double, of a power of two, of numbers just within and just beyond 2^40 times another, and some coordinates so small that all have just less and just more than 110 bits.
double unit_of(int i, fuzz::Random& random) {
  switch (i % 6) {
    case 0:
      return 0.1;
    case 1:
      return 0x1p-60;
    case 2:
      return 0x1.0000000002p0;
    case 3:
      return 0x1.0000000001p0;
    case 4:
      return random.one_in(3) ? 0x1p-107 : 1;
    default:
      return random.one_in(3) ? 0x1p-112 : 1;
  }
}

// Stage 3 is whole numbers, the oracle is CGAL: all positions of small grids, most of them degenerate.
TEST(ExactStage, AgreesWithTheOracleOnGrids) {
  fuzz::Random random(kSeed);
  int met = 0, in_plane = 0;
  for (int i = 0; i < 20000; ++i) {
    Corners t{};
    Segment s;
    for (Point* q : {&t[0], &t[1], &t[2], &s.a, &s.b}) {
      for (double& x : *q) x = random.between(-1, 1) * unit_of(i, random);
    }
    if (degenerate_exact(t)) continue;
    const bool expected = oracle_meets(s, t);
    ASSERT_EQ(meets_exact(s, t), expected) << i;
    ASSERT_EQ(oracle_first_block(s, t, nullptr).has_value(), expected) << i;
    const Meets filtered = meets_filtered(s, t);
    if (filtered != Meets::unsure) {
      ASSERT_EQ(filtered == Meets::yes, expected) << i;
    }
    met += expected ? 1 : 0;
    in_plane += expected && exact_sign(t[0], t[1], t[2], s.a) == Sign::zero ? 1 : 0;
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(in_plane, 200);
}

TEST(ExactStage, OrdersBlockersLikeTheOracle) {
  fuzz::Random random(kSeed);
  int same = 0, pairs = 0;
  std::array<int, 6> pairs_of{};
  for (int i = 0; i < 60000; ++i) {
    Corners t{}, r{};
    Segment s;
    for (Point* q : {&t[0], &t[1], &t[2], &r[0], &r[1], &r[2], &s.a, &s.b}) {
      for (double& x : *q) x = random.between(-2, 2) * unit_of(i, random);
    }
    if (degenerate_exact(t) || degenerate_exact(r)) continue;
    const auto x = oracle_first_block(s, t, nullptr), y = oracle_first_block(s, r, nullptr);
    if (!x || !y) continue;
    pairs_of[static_cast<std::size_t>(i % 6)] += 1;
    ASSERT_EQ(compare_first_exact(s, t, r, nullptr), *x < *y ? -1 : *x > *y ? 1 : 0) << i;
    ++pairs;
    same += *x == *y ? 1 : 0;
  }
  EXPECT_GT(pairs, 300);
  EXPECT_GT(same, 20);
  for (const int count : pairs_of) EXPECT_GT(count, 50);
}

TEST(FloatRules, HoldInThisProgram) { EXPECT_NO_THROW(require_float_rules()); }

}  // namespace
}  // namespace clues::fastpath
