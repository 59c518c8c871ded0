// The judges of a map: how often is something that it calls hidden seen after all?
#pragma once

#include <cstdint>

#include "support.h"

namespace clues::test {

struct Contradictions {
  std::uint64_t points = 0, seen_by_oracle = 0;            // D18, on points inside hidden regions
  std::uint64_t sight_lines = 0, seen_by_sight_lines = 0;  // D5, random, to the same points
  std::uint64_t invalid_witnesses = 0;  // gaps that the oracle reported and a plain segment test refutes
  std::uint64_t total() const { return seen_by_oracle + seen_by_sight_lines; }
};

Contradictions contradictions(const reference::VisibilityMap& map, std::size_t points_per_region, std::uint64_t seed);

}  // namespace clues::test
