// Signs of sums of roots and of the Delaunay determinant, against 2,000 binary digits.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "exact/motion/constraints.h"
#include "fuzz/generators/random.h"
#include "fuzz/motion/motion_cases.h"

namespace clues {
namespace {

constexpr mp_bitcnt_t kDigits = 2000;
using Float = mpf_class;

// What gmpxx makes on the way has the digits that are usual at the time.
const bool enough_digits = (mpf_set_default_prec(kDigits), true);

// Of a sum of numbers that are right to far more than 1,900 digits; a sum that is 0 comes out smaller than that.
int sign_of(const Float& sum, const Float& size) {
  EXPECT_TRUE(enough_digits);
  Float least(size, kDigits);
  mpf_div_2exp(least.get_mpf_t(), least.get_mpf_t(), 1800);
  if (abs(sum) <= least) return 0;
  return sgn(sum);
}

int sign_by_digits(const std::array<exact::SignedRoot, 4>& roots) {
  Float sum(0, kDigits), size(0, kDigits);
  for (const auto& root : roots) {
    const Float value = sqrt(Float(root.square, kDigits));
    sum += root.sign * value;
    size += value;
  }
  return sign_of(sum, size);
}

TEST(SignOfRoots, AgreesWithTwoThousandDigits) {
  fuzz::Random random(1);
  std::array<int, 3> seen{};
  for (int n = 0; n < 20'000; ++n) {
    std::array<exact::SignedRoot, 4> roots;
    for (auto& root : roots) root = {random.between(-1, 1), mpz_class(random.between(0, 40))};
    // a sqrt(q) of a few q: sums that vanish are common.
    if (n % 2 == 0) {
      const int q = random.between(1, 6), r = random.between(1, 6);
      const int a = random.between(1, 9), b = random.between(1, 9);
      roots = {{{1, a * a * q},
                {1, b * b * r},
                {-1, (a + 1) * (a + 1) * q},
                {random.between(0, 1) * 2 - 1, (b - 1) * (b - 1) * r}}};
      if (n % 4 == 0) roots = {{{1, a * a * q}, {-1, b * b * r}, {-1, a * a * q}, {1, b * b * r}}};
    }
    const int sign = exact::sign_of_sum(roots[0], roots[1], roots[2], roots[3]);
    ++seen[static_cast<std::size_t>(sign + 1)];
    ASSERT_EQ(sign, sign_by_digits(roots)) << n;
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(SignOfRoots, NumbersAreRootsOfTheirSquares) {
  // 3 - sqrt(2) - sqrt(3) < 0, and the same with fractions: 3/2 - sqrt(1/2) - sqrt(3/4) < 0
  EXPECT_EQ(exact::sign_of_sum({exact::as_root(3), exact::root_of(-1, 2), exact::root_of(-1, 3)}), -1);
  EXPECT_EQ(exact::sign_of_sum({exact::as_root(mpq_class(3, 2)), exact::root_of(-1, mpq_class(1, 2)),
                                exact::root_of(-1, mpq_class(3, 4))}),
            -1);
  EXPECT_EQ(exact::sign_of_sum({exact::as_root(5), exact::root_of(-1, 4), exact::root_of(-1, 9)}), 0);
  EXPECT_EQ(exact::sign_of_sum({exact::as_root(0), exact::root_of(7, 0)}), 0);
}

// By the definition: the determinant of the four rows (x, |x|).
int delaunay_by_digits(const std::array<exact::SightRow, 4>& rows) {
  const auto minor = [&](std::size_t a, std::size_t b, std::size_t c) {
    return Float(exact::determinant(rows[a], rows[b], rows[c]), kDigits);
  };
  const auto length = [&](std::size_t i) { return Float(sqrt(Float(rows[i].square, kDigits))); };
  const std::array<Float, 4> terms{Float(-length(0) * minor(1, 2, 3)), Float(length(1) * minor(0, 2, 3)),
                                   Float(-length(2) * minor(0, 1, 3)), Float(length(3) * minor(0, 1, 2))};
  Float sum(0, kDigits), size(0, kDigits);
  for (const auto& term : terms) {
    sum += term;
    size += abs(term);
  }
  return sign_of(sum, size);
}

void compare_with_digits(int cases, std::uint64_t seed) {
  std::array<int, 3> seen{}, seen_near{};
  for (int n = 0; n < cases; ++n) {
    // A tenth of the kinds is cocircular, a tenth one unit in the last place off.
    const auto kind = static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds);
    const auto test = fuzz::motion_case(kind, seed, static_cast<std::uint64_t>(n));
    std::array<exact::SightRow, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) rows[i] = exact::sight_row(test.mesh.samples[i], test.viewpoint);
    const int sign = exact::delaunay_sign(rows[0], rows[1], rows[2], rows[3]);
    ++seen[static_cast<std::size_t>(sign + 1)];
    if (kind == fuzz::MotionKind::one_ulp) ++seen_near[static_cast<std::size_t>(sign + 1)];
    ASSERT_EQ(sign, delaunay_by_digits(rows)) << n;
    if (kind == fuzz::MotionKind::cocircular) {
      ASSERT_EQ(sign, 0) << n;
    }
    // The two triangles of the edge agree.
    ASSERT_EQ(sign, exact::delaunay_sign(rows[3], rows[2], rows[1], rows[0])) << n;
  }
  for (const int count : seen) EXPECT_GT(count, cases / 25);
  EXPECT_GT(seen_near[0], cases / 100);
  EXPECT_GT(seen_near[2], cases / 100);
}

TEST(DelaunaySign, AgreesWithTwoThousandDigits) { compare_with_digits(20'000, 1); }
TEST(DelaunaySignLong, AgreesWithTwoThousandDigitsOnAMillion) { compare_with_digits(1'000'000, 2); }

// Planted: the sign from doubles. One unit in the last place must be too fine for it, or the cases above prove nothing.
TEST(DelaunaySign, DoublesAreCaught) {
  int wrong = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const auto test = fuzz::motion_case(fuzz::MotionKind::one_ulp, 3, n);
    std::array<exact::SightRow, 4> rows;
    std::array<std::array<double, 4>, 4> x{};
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i] = exact::sight_row(test.mesh.samples[i], test.viewpoint);
      for (std::size_t k = 0; k < 3; ++k) x[i][k] = test.mesh.samples[i].at[k] - test.viewpoint[k];
      x[i][3] = std::sqrt(x[i][0] * x[i][0] + x[i][1] * x[i][1] + x[i][2] * x[i][2]);
    }
    const auto minor = [&](std::size_t a, std::size_t b, std::size_t c) {
      return x[a][0] * (x[b][1] * x[c][2] - x[b][2] * x[c][1]) - x[a][1] * (x[b][0] * x[c][2] - x[b][2] * x[c][0]) +
             x[a][2] * (x[b][0] * x[c][1] - x[b][1] * x[c][0]);
    };
    const double g =
        -x[0][3] * minor(1, 2, 3) + x[1][3] * minor(0, 2, 3) - x[2][3] * minor(0, 1, 3) + x[3][3] * minor(0, 1, 2);
    const int sign = g > 0 ? 1 : g < 0 ? -1 : 0;
    if (sign != exact::delaunay_sign(rows[0], rows[1], rows[2], rows[3])) ++wrong;
  }
  EXPECT_GT(wrong, 200);
}

}  // namespace
}  // namespace clues
