// Whole numbers of 256 bits, as far as crossings of edges with diagonals need them (D33): a product of two numbers of 128 bits, sums, signs,
// and quotients rounded down. A quotient is guessed in doubles and then corrected by what is left over, in whole numbers, until that lies
// between 0 and the divisor: so the guess decides how long it takes, never what comes out.
#pragma once

#include <array>
#include <cstdint>

#include "exact/multires/grid.h"

namespace clues::fastpath::multires {

using exact::Wide;
__extension__ typedef unsigned __int128 WideBits;

// Two's complement, lowest limb first.
struct Wide256 {
  std::array<std::uint64_t, 4> limb{};

  bool negative() const { return (limb[3] >> 63) != 0; }
  bool zero() const { return (limb[0] | limb[1] | limb[2] | limb[3]) == 0; }
  friend Wide256 operator+(const Wide256& a, const Wide256& b) {
    Wide256 out;
    WideBits carry = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      carry += WideBits{a.limb[k]} + b.limb[k];
      out.limb[k] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return out;
  }
  friend Wide256 operator-(const Wide256& a) {
    Wide256 out;
    for (std::size_t k = 0; k < 4; ++k) out.limb[k] = ~a.limb[k];
    return out + Wide256{{1, 0, 0, 0}};
  }
  friend Wide256 operator-(const Wide256& a, const Wide256& b) { return a + -b; }
};

inline Wide256 product(Wide a, Wide b) {
  const bool negative = (a < 0) != (b < 0);
  const WideBits p = a < 0 ? -static_cast<WideBits>(a) : static_cast<WideBits>(a),
                 q = b < 0 ? -static_cast<WideBits>(b) : static_cast<WideBits>(b);
  const auto low = [](WideBits x) { return static_cast<std::uint64_t>(x); };
  const auto high = [](WideBits x) { return static_cast<std::uint64_t>(x >> 64); };
  const WideBits ll = WideBits{low(p)} * low(q), lh = WideBits{low(p)} * high(q), hl = WideBits{high(p)} * low(q),
                 hh = WideBits{high(p)} * high(q);
  const WideBits second = WideBits{high(ll)} + low(lh) + low(hl);
  const WideBits third = WideBits{high(second)} + high(lh) + high(hl) + low(hh);
  const Wide256 out{{low(ll), low(second), low(third), high(hh) + high(third)}};
  return negative ? -out : out;
}
inline Wide256 widened(Wide a) {
  const std::uint64_t sign = a < 0 ? ~std::uint64_t{0} : 0;
  const auto bits = static_cast<WideBits>(a);
  return {{static_cast<std::uint64_t>(bits), static_cast<std::uint64_t>(bits >> 64), sign, sign}};
}
// Of a number that has at most 250 bits.
inline Wide256 times(const Wide256& a, std::int64_t b) {
  const Wide256 size = a.negative() ? -a : a;
  const std::uint64_t factor = b < 0 ? -static_cast<std::uint64_t>(b) : static_cast<std::uint64_t>(b);
  Wide256 out;
  WideBits carry = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    carry += WideBits{size.limb[k]} * factor;
    out.limb[k] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return a.negative() != (b < 0) ? -out : out;
}
inline double roughly(const Wide256& a) {
  const Wide256 size = a.negative() ? -a : a;
  double out = 0;
  for (std::size_t k = 4; k-- > 0;) out = out * 0x1p64 + static_cast<double>(size.limb[k]);
  return a.negative() ? -out : out;
}
inline double roughly(Wide a) { return static_cast<double>(a); }
inline Wide times(Wide a, std::int64_t b) { return a * b; }
inline bool is_negative(Wide a) { return a < 0; }
inline bool is_negative(const Wide256& a) { return a.negative(); }

// floor(a / b) for a >= 0, b > 0 and a quotient below 2^62; `rest` is what is left over. b times 2^62 must not overflow.
template <class Number>
std::int64_t quotient(const Number& a, const Number& b, Number& rest) {
  const double guess = roughly(a) / roughly(b);
  auto q = static_cast<std::int64_t>(guess < 0x1p62 ? guess : 0x1p62);
  rest = a - times(b, q);
  while (is_negative(rest) || !is_negative(rest - b)) {
    auto step = static_cast<std::int64_t>(roughly(rest) / roughly(b));
    if (step == 0) step = is_negative(rest) ? -1 : 1;
    q += step;
    rest = rest - times(b, step);
  }
  return q;
}

}  // namespace clues::fastpath::multires
