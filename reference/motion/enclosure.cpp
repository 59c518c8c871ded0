// Outward rounding of rationals.
#include "reference/motion/enclosure.h"

#include <algorithm>

namespace clues::reference {
namespace {

constexpr long digits = 192;

// number * 2^shift
mpq_class shifted(const mpq_class& number, long shift) {
  mpq_class out;
  if (shift >= 0) {
    mpq_mul_2exp(out.get_mpq_t(), number.get_mpq_t(), static_cast<mp_bitcnt_t>(shift));
  } else {
    mpq_div_2exp(out.get_mpq_t(), number.get_mpq_t(), static_cast<mp_bitcnt_t>(-shift));
  }
  return out;
}

long magnitude(const mpq_class& number) {
  return static_cast<long>(mpz_sizeinbase(number.get_num_mpz_t(), 2)) -
         static_cast<long>(mpz_sizeinbase(number.get_den_mpz_t(), 2));
}

mpq_class rounded(const mpq_class& number, bool up) {
  if (sgn(number) == 0 || mpz_sizeinbase(number.get_den_mpz_t(), 2) + mpz_sizeinbase(number.get_num_mpz_t(), 2) <
                              static_cast<std::size_t>(digits)) {
    return number;
  }
  const long shift = digits - magnitude(number);
  const mpq_class scaled = shifted(number, shift);
  mpz_class whole;
  (up ? mpz_cdiv_q : mpz_fdiv_q)(whole.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  return shifted(mpq_class(whole), -shift);
}

mpq_class root_of(const mpq_class& number, bool up) {
  if (sgn(number) <= 0) return 0;
  const long shift = digits - magnitude(number) / 2;
  const mpq_class scaled = shifted(number, 2 * shift);
  mpz_class whole, rest;
  mpz_fdiv_q(whole.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  const bool exact_so_far = scaled.get_den() == 1;
  mpz_sqrtrem(whole.get_mpz_t(), rest.get_mpz_t(), whole.get_mpz_t());
  if (up && (!exact_so_far || sgn(rest) != 0)) ++whole;
  return shifted(mpq_class(whole), -shift);
}

}  // namespace

Enclosure::Enclosure(const mpq_class& from, const mpq_class& to) : low(rounded(from, false)), high(rounded(to, true)) {}

Enclosure operator+(const Enclosure& a, const Enclosure& b) { return {a.low + b.low, a.high + b.high}; }
Enclosure operator-(const Enclosure& a, const Enclosure& b) { return {a.low - b.high, a.high - b.low}; }
Enclosure operator*(const Enclosure& a, const Enclosure& b) {
  const mpq_class products[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  const auto [least, most] = std::minmax_element(std::begin(products), std::end(products));
  return {*least, *most};
}
Enclosure operator/(const Enclosure& a, const Enclosure& b) { return a * Enclosure(1 / b.high, 1 / b.low); }
Enclosure absolute(const Enclosure& a) {
  if (sgn(a.low) >= 0) return a;
  if (sgn(a.high) <= 0) return {-a.high, -a.low};
  return {0, std::max(mpq_class(-a.low), a.high)};
}
Enclosure square(const Enclosure& a) {
  const auto size = absolute(a);
  return {size.low * size.low, size.high * size.high};
}
Enclosure root(const Enclosure& a) { return {root_of(a.low, false), root_of(a.high, true)}; }

EnclosedVector enclosed(const exact::RationalVector& a) { return {Enclosure(a[0]), Enclosure(a[1]), Enclosure(a[2])}; }
EnclosedVector operator+(const EnclosedVector& a, const EnclosedVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
EnclosedVector operator-(const EnclosedVector& a, const EnclosedVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
EnclosedVector operator*(const Enclosure& factor, const EnclosedVector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Enclosure length(const EnclosedVector& a) { return root(square(a[0]) + square(a[1]) + square(a[2])); }

}  // namespace clues::reference
