// The largest double for which something holds that holds up to some radius and not beyond: by halving the bit patterns of the positive
// doubles, which stand in the order of their values. 64 questions. Where the answers are only proved from below, what is returned
// was proved.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "exact/last_where.h"

namespace clues::reference {

// 0 when it holds for no positive double, infinity when it holds for all radii: viewpoints are not doubles, and samples may be two largest
// doubles apart. No finite bound of samples and thresholds that are doubles comes near 2^4096: where it holds up to there, it holds everywhere.
// `known`: what it is known to hold for already; when it holds for nothing beyond, that takes one question. holds(const mpq_class&).
template <class Holds>
double largest_double(const Holds& holds_for, double known = 0) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto holds = [&](double radius) { return holds_for(mpq_class(radius)); };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (known == infinity) return known;
  if (known == most || holds(most)) return holds_for(mpq_class(mpz_class(1) << 4096U)) ? infinity : most;
  const auto below = std::bit_cast<std::uint64_t>(known);
  if (known > 0 && !holds(std::bit_cast<double>(below + 1))) return known;
  return std::bit_cast<double>(exact::last_where(below, std::bit_cast<std::uint64_t>(most), [&](std::uint64_t bits) {
    return holds(std::bit_cast<double>(bits));
  }));
}

// The largest double of at most 21 binary digits for which it holds, or `known` if that is larger: half the questions, where a lower bound within a millionth is
// as good. Finite; what is scaled by a power of two gives what is scaled so.
template <class Holds>
double largest_short_double(const Holds& holds_for, double known) {
  const auto number = [](std::uint64_t upper) { return std::bit_cast<double>(upper << 32U); };
  const auto upper_half = [](double x) { return std::bit_cast<std::uint64_t>(x) >> 32U; };
  const auto last = exact::last_where(upper_half(known), upper_half(std::numeric_limits<double>::max()),
                                      [&](std::uint64_t upper) { return holds_for(mpq_class(number(upper))); });
  return std::max(known, number(last));
}

}  // namespace clues::reference
