// The largest double for which something holds that holds up to some radius and not beyond: by halving the bit patterns of the positive
// doubles, which stand in the order of their values. 64 questions. Where the answers are only proved from below, what is returned
// was proved.
#pragma once

#include <gmpxx.h>

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

}  // namespace clues::reference
