// Coverage of the method: which rules of the definition a map rested on, as far as the map shows it, and which of them in one case. Each kind of scene meets the
// rule that it was made for; what nobody thought of is two rules at once.
#pragma once

#include <string>
#include <vector>

#include "fuzz/findings/finding.h"
#include "reference/visibility/first_order.h"

namespace clues::fuzz {

// By number, with what is meant of it: "D12 inside corner".
const std::vector<std::string>& all_rules();

// Adds "rule R" for each that was met, and "pair R + Q" for each two, in their order.
void count_rules(const Case& scene, const reference::VisibilityMap& map, Counters& counters);

inline bool is_a_pair(const std::string& counter) { return counter.starts_with("pair "); }

// Of all pairs of rules that can meet at all: how many, and which never did.
struct PairsMet {
  std::size_t met = 0, all = 0;
  std::vector<std::string> never;  // "R + Q"
};
PairsMet pairs_met(const Counters& counters);

}  // namespace clues::fuzz
