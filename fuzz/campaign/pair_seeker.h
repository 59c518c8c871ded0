// Which cases come next in a campaign that looks for pairs of rules that were never met in one case (rules.h): those of generators, strengths and dials that
// still find new pairs. The cases are those of any campaign, with the same numbers; only which of them, and when, is chosen, by what came of earlier ones.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fuzz/findings/store.h"

namespace clues::fuzz {

// Each case has marks: its generator at its strength (number of the scene modulo 8), and the dials that are turned in it, or that none is. A mark that k chosen
// cases had, which found n new pairs, is worth (n + 1) / (k + 2), and what is long ago counts less: k and n lose an eighth with every round. A case is worth what its generator and
// the best of its dials are together. The next is the one worth most of the next four of each generator and strength, of equal ones that with the lowest number; what it overtakes there
// is left out. But first of all each generator has one case of each strength. So what found something lately comes more often, and all come by turns where nothing does.
//
// Cases are chosen in rounds. A round is a function of what came of all rounds but the last, so that the order does not depend on who works on what, and more than
// a round of cases can be worked on at once.
class PairSeeker {
 public:
  using DialsOf = std::function<CaseDials(std::uint64_t number)>;

  // Case n is of generator n modulo `generators`, of which there is at least one.
  PairSeeker(std::uint64_t generators, DialsOf dials_of);

  // What an earlier run was told: its cases, in order, and its counters. Before anything else, once. Throws scene::Error malformed where these are not the cases that are chosen here.
  void resume(const std::vector<SoughtCase>& told, const Counters& counters);

  std::uint64_t round() const { return 2 * generators_; }                  // cases
  bool knows(std::uint64_t place) const { return place < order_.size(); }  // the case at this place of the order
  std::uint64_t number(std::uint64_t place) const { return order_[place].number; }

  // What came of the next case in the order. Returns how many pairs it is the first to meet.
  std::uint64_t tell(const Counters& counters);

 private:
  struct Mark {
    double cases = 0, found = 0;
    double worth() const { return (found + 1) / (cases + 2); }
    void age() {
      cases *= 0.875;
      found *= 0.875;
    }
  };
  struct Chosen {
    std::uint64_t number = 0;
    std::vector<std::string> dials;
  };

  std::size_t arm_of(std::uint64_t number) const;
  Chosen with_dials(std::uint64_t number) const;
  double worth(const Chosen& c) const;
  void choose_round();
  void choose();
  void told(std::uint64_t new_pairs);

  std::uint64_t generators_;
  DialsOf dials_of_;
  std::vector<Mark> arms_;  // of each generator the strengths
  std::map<std::string, Mark> dials_;
  std::vector<std::vector<Chosen>> next_;  // of each arm what comes next
  std::vector<Chosen> order_;              // of the rounds that are chosen
  std::vector<std::uint64_t> found_;       // new pairs of the cases that were told
  std::set<std::string> met_;
};

}  // namespace clues::fuzz
