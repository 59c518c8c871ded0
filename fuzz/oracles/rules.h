// Coverage of the method: which rules of the definition a map rested on, as far as the map shows it, and which of them in one case. Each kind of scene meets the
// rule that it was made for; what nobody thought of is two rules at once.
#pragma once

#include <string>
#include <vector>

#include "fuzz/findings/finding.h"
#include "reference/visibility/first_order.h"

namespace clues::fuzz {

// Adds "rule R" for each that was met, such as "rule D12 inside corner", and "pair R + Q" for each two, in their order.
void count_rules(const Case& scene, const reference::VisibilityMap& map, Counters& counters);

inline bool is_a_pair(const std::string& counter) { return counter.starts_with("pair "); }

// What a campaign met: of the pairs whose rules were each met, and that can meet at all.
struct RulesMet {
  std::vector<std::string> never;               // rules
  std::size_t pairs = 0, all_pairs = 0;         // met, of all that can meet
  std::size_t impossible = 0;                   // pairs that cannot; the reasons are in rules.cpp
  std::vector<std::string> wrongly_impossible;  // ... and did, with the reason: must stay empty
  std::vector<std::string> apart;               // "R + Q": each was met, and never both
};
RulesMet rules_met(const Counters& counters);

}  // namespace clues::fuzz
