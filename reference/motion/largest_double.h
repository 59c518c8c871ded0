// The largest double for which something holds that holds up to some radius and not beyond: by halving the bit patterns of the positive
// doubles, which stand in the order of their values. 64 questions. Where the answers are only proved from below, what is returned
// was proved.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

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
  std::uint64_t below = std::bit_cast<std::uint64_t>(known), above = std::bit_cast<std::uint64_t>(most);
  if (known > 0 && !holds(std::bit_cast<double>(below + 1))) return known;
  while (above - below > 1) {
    const auto middle = below + (above - below) / 2;
    (holds(std::bit_cast<double>(middle)) ? below : above) = middle;
  }
  return std::bit_cast<double>(below);
}

// The largest double of at most 21 binary digits for which it holds, or `known` if that is larger: half the questions, where a lower bound within a millionth is
// as good. Finite; what is scaled by a power of two gives what is scaled so.
template <class Holds>
double largest_short_double(const Holds& holds_for, double known) {
  const auto number = [](std::uint64_t upper) { return std::bit_cast<double>(upper << 32U); };
  const auto upper_half = [](double x) { return std::bit_cast<std::uint64_t>(x) >> 32U; };
  std::uint64_t below = upper_half(known), above = upper_half(std::numeric_limits<double>::max());
  while (above - below > 1) {
    const auto middle = below + (above - below) / 2;
    (holds_for(mpq_class(number(middle))) ? below : above) = middle;
  }
  return std::max(known, number(below));
}

}  // namespace clues::reference
