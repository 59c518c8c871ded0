// Differences of doubles as whole numbers: mantissas, shifted to the smallest exponent among them.
#include "exact/motion/sight_row.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clues::exact {
namespace {

constexpr int no_exponent = std::numeric_limits<int>::max();

struct Mantissa {
  std::int64_t value = 0;
  int exponent = no_exponent;  // no_exponent: zero
};

Mantissa mantissa_of(double x) {
  if (x == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  constexpr int digits = std::numeric_limits<double>::digits;
  return {static_cast<std::int64_t>(std::ldexp(fraction, digits)), exponent - digits};
}

void set(mpz_class& out, const Mantissa& m, int exponent) {
  static_assert(sizeof(long) == sizeof(std::int64_t));
  out = static_cast<long>(m.value);
  if (m.value != 0) mpz_mul_2exp(out.get_mpz_t(), out.get_mpz_t(), static_cast<mp_bitcnt_t>(m.exponent - exponent));
}

void set_square(SightRow& row) {
  row.square = row.x[0] * row.x[0];
  mpz_addmul(row.square.get_mpz_t(), row.x[1].get_mpz_t(), row.x[1].get_mpz_t());
  mpz_addmul(row.square.get_mpz_t(), row.x[2].get_mpz_t(), row.x[2].get_mpz_t());
}

}  // namespace

ExactViewpoint exact_viewpoint(const scene::MotionPoint& at) {
  return {mpq_class(at[0]), mpq_class(at[1]), mpq_class(at[2])};
}

SightRow sight_row(const scene::DepthSample& sample, const scene::MotionPoint& viewpoint) {
  std::array<Mantissa, 3> to, from;
  int exponent = no_exponent;
  for (std::size_t i = 0; i < 3; ++i) {
    to[i] = mantissa_of(sample.at[i]);
    if (!sample.is_direction) from[i] = mantissa_of(viewpoint[i]);
    exponent = std::min({exponent, to[i].exponent, from[i].exponent});
  }
  SightRow row;
  mpz_class subtrahend;
  for (std::size_t i = 0; i < 3; ++i) {
    set(row.x[i], to[i], exponent);
    if (from[i].value == 0) continue;
    set(subtrahend, from[i], exponent);
    row.x[i] -= subtrahend;
  }
  set_square(row);
  return row;
}

SightRow sight_row(const scene::DepthSample& sample, const ExactViewpoint& viewpoint) {
  std::array<mpq_class, 3> x;
  mpz_class multiple = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = sample.at[i];
    if (!sample.is_direction) x[i] -= viewpoint[i];
    mpz_lcm(multiple.get_mpz_t(), multiple.get_mpz_t(), x[i].get_den_mpz_t());
  }
  SightRow row;
  for (std::size_t i = 0; i < 3; ++i) row.x[i] = x[i].get_num() * (multiple / x[i].get_den());
  set_square(row);
  return row;
}

mpz_class determinant(const SightRow& a, const SightRow& b, const SightRow& c) {
  mpz_class sum, minor;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    mpz_mul(minor.get_mpz_t(), b.x[j].get_mpz_t(), c.x[k].get_mpz_t());
    mpz_submul(minor.get_mpz_t(), b.x[k].get_mpz_t(), c.x[j].get_mpz_t());
    mpz_addmul(sum.get_mpz_t(), a.x[i].get_mpz_t(), minor.get_mpz_t());
  }
  return sum;
}

mpz_class dot(const SightRow& a, const SightRow& b) {
  mpz_class sum = a.x[0] * b.x[0];
  mpz_addmul(sum.get_mpz_t(), a.x[1].get_mpz_t(), b.x[1].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a.x[2].get_mpz_t(), b.x[2].get_mpz_t());
  return sum;
}

}  // namespace clues::exact
