// The filters of maps in doubles: constants recomputed, answers against whole numbers, and what a filter without its error term says.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fastpath/multires/crossing.h"
#include "fastpath/multires/grid_signs.h"
#include "fuzz/generators/random.h"

namespace clues {
namespace {

using namespace fastpath::multires;
using exact::FlatPoint;

const mpq_class unit_roundoff(0x1p-53);

mpq_class to_power(const mpq_class& x, int n) {
  mpq_class out = 1;
  for (int k = 0; k < n; ++k) out *= x;
  return out;
}

// Two roundings of differences and products, and one of the difference of these, for points whose coordinates have errors `of_point` and are at most
// `size` away from a corner: as derived in grid_signs.h.
mpq_class side_error(const mpq_class& of_point, const mpq_class& size) {
  const mpq_class& u = unit_roundoff;
  const mpq_class difference = of_point + u * (size + of_point);
  const mpq_class product = 2 * difference + u * (2 * size + 2 * difference);
  return 2 * product + u * (4 * size + 2 * product);
}

TEST(FastMapFilters, ConstantsAreAsDerived) {
  const mpq_class& u = unit_roundoff;
  const mpq_class e = to_power(1 + u, 4) - 1;
  const mpq_class side = side_error(e, 2);
  EXPECT_GE(mpq_class(kSideError), side);
  EXPECT_LT(mpq_class(kSideError), side * mpq_class(102, 100));
  const mpq_class first = u * (2 + 2 * e), sum = 3 * e + first + u * (3 + 3 * e + first);
  const mpq_class middle = side_error(sum, 6);
  EXPECT_GE(mpq_class(kMiddleError), middle);
  EXPECT_LT(mpq_class(kMiddleError), middle * mpq_class(102, 100));
  const mpq_class circle = (to_power(1 + u, 3) - 1) / to_power(1 - u, 4);  // the bound itself is rounded, too
  EXPECT_GE(mpq_class(kInCircleError), circle);
  EXPECT_LT(mpq_class(kInCircleError), circle * mpq_class(102, 100));
}

std::int64_t coordinate(fuzz::Random& random, std::int64_t size) {
  return random.between(-static_cast<int>(size), static_cast<int>(size));
}

// Most of them on or near one circle: whole points of x^2 + y^2 = 5^2 13^2 17^2 ..., scaled.
std::array<DiskPoint, 4> four_points(fuzz::Random& random) {
  constexpr std::array<std::array<std::int64_t, 2>, 6> on_circle{
      {{63, 16}, {60, 25}, {56, 33}, {52, 39}, {65, 0}, {39, 52}}};
  std::array<DiskPoint, 4> out;
  const std::int64_t scale = random.between(1, 250000);
  for (auto& p : out) {
    if (random.one_in(3)) {
      p = {coordinate(random, 1 << 24), coordinate(random, 1 << 24)};
      continue;
    }
    const auto& c = on_circle[static_cast<std::size_t>(random.between(0, 5))];
    p = {scale * c[0] * (random.one_in(2) ? 1 : -1), scale * c[1] * (random.one_in(2) ? 1 : -1)};
    if (random.one_in(4)) p[0] += random.between(-1, 1);
  }
  return out;
}

TEST(FastMapFilters, InCircleNeverContradicts) {
  fuzz::Random random(1);
  int sure = 0, unsure_ones = 0, zeros = 0, wrong_without_term = 0;
  for (int k = 0; k < 200000; ++k) {
    const auto p = four_points(random);
    const int sign = exact::in_circle(p[0], p[1], p[2], p[3]);
    const int fast = in_circle_filtered(p[0], p[1], p[2], p[3]);
    ++(fast == unsure ? unsure_ones : sure);
    zeros += sign == 0 ? 1 : 0;
    ASSERT_TRUE(fast == unsure || fast == sign) << k;
    const int bold = in_circle_filtered(p[0], p[1], p[2], p[3], 0);
    wrong_without_term += bold != unsure && bold != sign ? 1 : 0;
  }
  EXPECT_GT(sure, 100000);
  EXPECT_GT(unsure_ones, 1000);
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(wrong_without_term, 0);
}

// A point of a star, in both kinds of numbers, as the fast path makes them.
struct Placed {
  FlatPoint flat;
  DiskDouble about;
};
Placed placed(const std::array<DiskPoint, 3>& corners, const std::array<std::int64_t, 3>& weights) {
  Placed out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.flat.x += Wide{corners[k][0]} * weights[k];
    out.flat.y += Wide{corners[k][1]} * weights[k];
    const double weight = static_cast<double>(weights[k]) * 0x1p-60;
    out.about.x += in_doubles(corners[k]).x * weight;
    out.about.y += in_doubles(corners[k]).y * weight;
  }
  return out;
}

// On the line from one corner to another, but for some units.
Placed near_line(fuzz::Random& random, const std::array<DiskPoint, 3>& c) {
  const auto part = static_cast<std::int64_t>(random.next() >> 4);
  const std::int64_t off = random.one_in(3) ? 0 : std::int64_t{1} << random.between(0, 24);
  if (part <= off) return placed(c, {scene::whole_weight - off, 0, off});
  return placed(c, {scene::whole_weight - part, part - off, off});
}

TEST(FastMapFilters, SidesNeverContradict) {
  fuzz::Random random(2);
  int sure = 0, zeros = 0, wrong_without_term = 0, wrong_middles = 0;
  for (int k = 0; k < 200000; ++k) {
    std::array<DiskPoint, 3> c;
    for (auto& p : c) p = {coordinate(random, 1 << 24), coordinate(random, 1 << 24)};
    const std::array<Placed, 3> f{near_line(random, c), near_line(random, c), near_line(random, c)};
    const DiskDouble a = in_doubles(c[0]), b = in_doubles(c[1]);
    const int sign = exact::sign_of(exact::orientation(c[0], c[1], f[0].flat));
    const int fast = side_filtered(a, b, f[0].about), bold = side_filtered(a, b, f[0].about, 1, 0);
    ASSERT_TRUE(fast == unsure || fast == sign) << k;
    sure += fast != unsure ? 1 : 0;
    zeros += sign == 0 ? 1 : 0;
    wrong_without_term += bold != unsure && bold != sign ? 1 : 0;
    const DiskDouble sum{f[0].about.x + f[1].about.x + f[2].about.x, f[0].about.y + f[1].about.y + f[2].about.y};
    const Wide dx = f[0].flat.x + f[1].flat.x + f[2].flat.x - Wide{3} * c[0][0] * scene::whole_weight,
               dy = f[0].flat.y + f[1].flat.y + f[2].flat.y - Wide{3} * c[0][1] * scene::whole_weight;
    const int third = exact::sign_of((c[1][0] - c[0][0]) * dy - (c[1][1] - c[0][1]) * dx);
    const int middle = middle_filtered(a, b, sum), bold_middle = middle_filtered(a, b, sum, 0);
    ASSERT_TRUE(middle == unsure || middle == third) << k;
    wrong_middles += bold_middle != unsure && bold_middle != third ? 1 : 0;
  }
  EXPECT_GT(sure, 10000);
  EXPECT_GT(zeros, 10000);
  EXPECT_GT(wrong_without_term, 100);
  EXPECT_GT(wrong_middles, 100);
}

Wide wide(fuzz::Random& random, int bits) {
  const Wide value =
      (Wide{static_cast<std::int64_t>(random.next() >> 1)} << 63) + static_cast<std::int64_t>(random.next() >> 1);
  return value >> (126 - bits);
}

mpz_class integer(const Wide256& a) {
  const Wide256 size = a.negative() ? -a : a;
  mpz_class out = 0;
  for (std::size_t k = 4; k-- > 0;) {
    out <<= 64;
    out += static_cast<unsigned long>(size.limb[k]);
  }
  return a.negative() ? mpz_class(-out) : out;
}

TEST(FastMapNumbers, AreThoseOfGmp) {
  fuzz::Random random(3);
  for (int k = 0; k < 100000; ++k) {
    const Wide a = wide(random, random.between(1, 112)) * (random.one_in(2) ? 1 : -1),
               b = wide(random, random.between(1, 112));
    const auto whole = [](Wide x) { return integer(widened(x)); };
    ASSERT_EQ(integer(product(a, b)), whole(a) * whole(b));
    ASSERT_EQ(integer(product(a, b) + product(b, b)), whole(a) * whole(b) + whole(b) * whole(b));
    ASSERT_EQ(integer(product(a, b) - widened(b)), whole(a) * whole(b) - whole(b));
    const std::int64_t factor = static_cast<std::int64_t>(random.next() >> 4) * (random.one_in(2) ? 1 : -1);
    ASSERT_EQ(integer(times(widened(a), factor)), whole(a) * mpz_class(factor));
    // Quotients of all sizes below 2^60, and such as are whole, or miss that by one.
    const Wide divisor = b + 1;
    const std::int64_t q = static_cast<std::int64_t>(random.next() >> random.between(4, 63));
    Wide256 number = times(widened(divisor), q), rest;
    if (random.one_in(2)) number = number + widened(random.one_in(2) ? b : Wide{1} % divisor);
    ASSERT_EQ(quotient(number, widened(divisor), rest), q);
    ASSERT_EQ(integer(rest), integer(number) - whole(divisor) * mpz_class(q));
  }
}

}  // namespace
}  // namespace clues
