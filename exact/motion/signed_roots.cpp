// Signs of sums of square roots by squaring: two against two, so that two roots are left; again, so that one is; and once more.
#include "exact/motion/signed_roots.h"

#include <array>

namespace clues::exact {
namespace {

// The sign of number + factor * sqrt(square), where factor is a whole number and square >= 0.
int sign_with_root(const mpz_class& number, const mpz_class& factor, const mpz_class& square) {
  const int a = sgn(number);
  const int b = sgn(square) == 0 ? 0 : sgn(factor);
  if (b == 0 || a == b) return a;
  if (a == 0) return b;
  const mpz_class first = number * number;
  const mpz_class second = factor * factor * square;
  return first > second ? a : first < second ? b : 0;
}

}  // namespace

int sign_of_sum(const SignedRoot& a, const SignedRoot& b) {
  const int s = sgn(a.square) == 0 ? 0 : a.sign;
  const int t = sgn(b.square) == 0 ? 0 : b.sign;
  if (t == 0 || s == t) return s;
  if (s == 0) return t;
  const int order = cmp(a.square, b.square);
  return order > 0 ? s : order < 0 ? t : 0;
}

int sign_of_sum(const SignedRoot& a, const SignedRoot& b, const SignedRoot& c) { return sign_of_sum(a, b, c, {}); }

// With X = a + b and Y = c + d of opposite signs, |X| against |Y| is X^2 - Y^2 = A + B, where A = a^2 + b^2 - c^2 - d^2 is a number and
// B = 2 ab - 2 cd two roots; where these are opposite, A^2 - B^2 is a number and one root, 8 abcd.
int sign_of_sum(const SignedRoot& a, const SignedRoot& b, const SignedRoot& c, const SignedRoot& d) {
  for (const auto* root : {&a, &b, &c, &d}) {
    if (root->sign != 0 || sgn(root->square) == 0) continue;
    const auto plain = [](const SignedRoot& r) { return r.sign == 0 ? SignedRoot{} : r; };
    return sign_of_sum(plain(a), plain(b), plain(c), plain(d));
  }
  const int x = sign_of_sum(a, b);
  const int y = sign_of_sum(c, d);
  if (y == 0 || x == y) return x;
  if (x == 0) return y;
  const mpz_class number = a.square + b.square - c.square - d.square;
  const SignedRoot ab{a.sign * b.sign, a.square * b.square};
  const SignedRoot minus_cd{-c.sign * d.sign, c.square * d.square};
  const int roots = sign_of_sum(ab, minus_cd);
  const int plain = sgn(number);
  int order = 0;  // of |X| and |Y|
  if (roots == 0 || plain == roots) {
    order = plain;
  } else if (plain == 0) {
    order = roots;
  } else {
    const mpz_class rest = number * number - 4 * (ab.square + minus_cd.square);
    const mpz_class factor = -8 * ab.sign * minus_cd.sign;
    order = plain * sign_with_root(rest, factor, ab.square * minus_cd.square);
  }
  return order > 0 ? x : order < 0 ? y : 0;
}

int sign_of_sum(std::initializer_list<SignedRationalRoot> roots) {
  mpz_class multiple = 1;
  for (const auto& root : roots) {
    mpz_lcm(multiple.get_mpz_t(), multiple.get_mpz_t(), root.square.get_den_mpz_t());
  }
  std::array<SignedRoot, 4> whole;
  std::size_t used = 0;
  for (const auto& root : roots) {
    auto& next = whole.at(used++);
    next.sign = root.sign;
    next.square = root.square.get_num() * (multiple / root.square.get_den());
  }
  return sign_of_sum(whole[0], whole[1], whole[2], whole[3]);
}

}  // namespace clues::exact
