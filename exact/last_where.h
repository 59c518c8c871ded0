// Where something ceases to hold, among whole numbers. The bit patterns of positive doubles stand in the order of their values, so that this finds doubles, too.
#pragma once

#include <cstdint>

namespace clues::exact {

// The last number for which it holds, where it holds for `below` and no more from some number on, `above` at the latest. At most 64 questions; below and above are not asked about.
template <class Holds>
std::uint64_t last_where(std::uint64_t below, std::uint64_t above, const Holds& holds) {
  while (above - below > 1) {
    const std::uint64_t middle = below + (above - below) / 2;
    (holds(middle) ? below : above) = middle;
  }
  return below;
}

}  // namespace clues::exact
