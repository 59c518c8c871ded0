// The filters of maps in doubles: constants recomputed, answers against whole numbers, and what a filter without its error term says.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fastpath/multires/crossing.h"
#include "fastpath/multires/grid_signs.h"
#include "fuzz/generators/random.h"
#include "reference/multires/overlay.h"
#include "reference/multires/stars/combination.h"

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

std::int64_t weight_below(fuzz::Random& random, std::int64_t most) {
  const auto any = static_cast<std::int64_t>(random.next() >> random.between(4, 63));
  return most == 0 ? 0 : any % (most + 1);
}
std::array<std::int64_t, 3> three_weights(fuzz::Random& random) {
  const std::int64_t a = weight_below(random, scene::whole_weight), b = weight_below(random, scene::whole_weight - a);
  std::array<std::int64_t, 3> out{scene::whole_weight - a - b, a, b};
  std::swap(out[0], out[static_cast<std::size_t>(random.between(0, 2))]);
  return out;
}

// Slivers and whole disks; points inside, on edges, at corners, and off by units. Against GMP and 128 bits.
TEST(FastMapNumbers, WeightsAreTheReferences) {
  fuzz::Random random(4);
  int found = 0, none = 0;
  for (int k = 0; k < 200000; ++k) {
    std::array<DiskPoint, 3> c;
    for (auto& p : c) {
      const std::int64_t size = std::int64_t{1} << random.between(1, 24);
      p = {coordinate(random, size), coordinate(random, size)};
    }
    if (exact::orientation(c[0], c[1], c[2]) < 0) std::swap(c[1], c[2]);
    if (exact::orientation(c[0], c[1], c[2]) == 0) continue;
    auto point = placed(c, three_weights(random)).flat;
    if (random.one_in(3)) point.x += random.between(-3, 3);
    const scene::Triangle triangle{static_cast<std::uint32_t>(random.between(0, 9)),
                                   10 + static_cast<std::uint32_t>(k % 2) * 7, 12};
    const auto expected = reference::weights_in(triangle, c, point);
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) inside = inside && exact::orientation(c[i], c[(i + 1) % 3], point) >= 0;
    if (!inside) continue;  // is not asked
    ASSERT_EQ(weights_in(triangle, c, point), expected) << k;
    ++(expected ? found : none);
  }
  EXPECT_GT(found, 50000);
  EXPECT_GT(none, 100);
}

scene::CarrierPoint carrier_point(fuzz::Random& random, std::uint32_t from) {
  const auto weights = three_weights(random);
  scene::CarrierPoint out;
  std::size_t used = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (weights[i] == 0) continue;
    out.corner[used] = from + 2 * i;
    out.weight[used++] = weights[i];
  }
  return out;
}

TEST(FastMapNumbers, MeansAndCrossingsAreTheReferences) {
  fuzz::Random random(5);
  int none = 0;
  for (int k = 0; k < 100000; ++k) {
    const auto x = carrier_point(random, 4), y = carrier_point(random, random.one_in(9) ? 5 : 4);
    const Parts parts{wide(random, random.between(1, 112)) + 1, wide(random, random.between(1, 112)) + 1};
    const mpz_class of_x = integer(widened(parts.of_x)), of_y = integer(widened(parts.of_y));
    const auto mean = mean_of(x, y, parts);
    ASSERT_EQ(mean, reference::combined({{&x, of_x}, {&y, of_y}})) << k;
    none += mean ? 0 : 1;
  }
  EXPECT_GT(none, 1000);
  int within = 0;
  for (int k = 0; k < 100000; ++k) {
    std::array<DiskPoint, 3> c;
    for (auto& p : c) p = {coordinate(random, 1 << 24), coordinate(random, 1 << 24)};
    const FlatPoint x = placed(c, three_weights(random)).flat,
                    y = placed({c[2], c[1], c[0]}, three_weights(random)).flat;
    const DiskPoint a{coordinate(random, 1 << 24), coordinate(random, 1 << 24)},
        b{coordinate(random, 1 << 24), c[0][1]};
    const Wide one = exact::orientation(a, b, x), two = exact::orientation(a, b, y);
    if (exact::sign_of(one) * exact::sign_of(two) >= 0) continue;
    const Parts parts{two > 0 ? two : -two, one > 0 ? one : -one};
    // The crossing, as a rational: its place along the longer axis.
    const std::size_t axis = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]) ? 0 : 1;
    const auto whole = [](Wide value) { return mpq_class(integer(widened(value))); };
    const mpq_class way =
        (whole(parts.of_x) * whole(axis == 0 ? x.x : x.y) + whole(parts.of_y) * whole(axis == 0 ? y.x : y.y)) /
            whole(parts.of_x + parts.of_y) -
        mpq_class(mpz_class(a[axis])) * mpq_class(mpz_class(scene::whole_weight));
    const mpq_class place = way / mpq_class(mpz_class(b[axis] - a[axis]));
    const auto found = place_on_diagonal(a, b, x, y, parts);
    ASSERT_EQ(found.has_value(), place > 0 && place < mpq_class(mpz_class(scene::whole_weight))) << k;
    if (!found) continue;
    ++within;
    mpz_class floor;
    mpz_fdiv_q(floor.get_mpz_t(), place.get_num_mpz_t(), place.get_den_mpz_t());
    ASSERT_EQ(mpz_class(*found), floor) << k;
  }
  EXPECT_GT(within, 1000);
}

}  // namespace
}  // namespace clues
