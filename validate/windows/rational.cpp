// Rational vectors: conversions.
#include "validate/windows/rational.h"

namespace clues::validate {
namespace {

Rational read(const exact::FT& x) { return Rational(exact::to_string_exact(x)); }

exact::FT to_field(const Rational& x) { return exact::FT(exact::FT::Exact_type(x.get_str())); }

}  // namespace

void make_primitive(const RVector& a, const RVector& b, IVector& a_out, IVector& b_out) {
  Integer multiple = 1;
  for (const RVector* v : {&a, &b}) {
    for (const Rational& x : *v) mpz_lcm(multiple.get_mpz_t(), multiple.get_mpz_t(), x.get_den_mpz_t());
  }
  Integer divisor = 0;
  const auto scale = [&](const RVector& v, IVector& out) {
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = v[i].get_num() * (multiple / v[i].get_den());
      mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), out[i].get_mpz_t());
    }
  };
  scale(a, a_out);
  scale(b, b_out);
  if (sgn(divisor) == 0) return;
  for (IVector* v : {&a_out, &b_out}) {
    for (Integer& x : *v) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  }
}

IVector primitive(const RVector& a) {
  IVector out, unused;
  make_primitive(a, RVector{}, out, unused);
  return out;
}

RVector read(const exact::Point3& p) { return {read(p.x()), read(p.y()), read(p.z())}; }

exact::Point3 to_point(const RVector& p) { return {to_field(p[0]), to_field(p[1]), to_field(p[2])}; }

}  // namespace clues::validate
