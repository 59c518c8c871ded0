// What an answer is worth, against what the suite proves (D7, D19): every triangle of a case is either visible with a proof or hidden with a
// proof, so nothing is left undecided here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "validate/conform/protocol.h"
#include "validate/vectors/suite.h"

namespace clues::validate {

enum class Outcome {
  tight,         // exactly the visible triangles
  conservative,  // all visible triangles, and others
  unsound,       // a visible triangle is missing
  // No PVS; as the AnswerKind of the same name.
  unsupported,
  skipped,
  rejected_input,
  malformed_output,
  errored,
  crash,
  timeout,
  resource,
};
inline constexpr std::size_t outcome_count = 11;

const char* to_string(Outcome outcome);

// unsound, malformed_output, crash, timeout: what no implementation may do.
bool is_failure(Outcome outcome);
// errored, resource: the case was put, and no answer came that could be judged.
bool is_unanswered(Outcome outcome);
// The case was put to the implementation, and something came of it that could be judged.
bool is_executed(Outcome outcome);

struct CaseResult {
  const VectorCase* test = nullptr;
  Outcome outcome = Outcome::tight;
  Answer answer;
  // Of a PVS. Triangles without area count nowhere: they are no surface. Nor do those that nobody asks about (D22).
  std::vector<const MustBeVisible*> missed;       // visible, not listed
  std::vector<std::uint32_t> extra;               // hidden, listed
  std::vector<std::uint32_t> out_of_first_order;  // listed, though not even first-order visible (T1)

  bool has_pvs() const { return answer.kind == AnswerKind::visible; }
};

CaseResult grade(const VectorCase& test, Answer answer);

// Sums over cases with a PVS. Bittner et al. 2005: the overestimate Qo is extra/exact, the underestimate Qu missed/exact.
struct Tally {
  std::uint64_t cases = 0;
  std::uint64_t outcomes[outcome_count] = {};
  std::uint64_t exact = 0, extra = 0, missed = 0;  // triangles
  std::uint64_t within_first_order = 0,
                looser = 0;  // cases with a PVS, by whether all that it lists is first-order visible

  void add(const CaseResult& result);
  std::uint64_t of(Outcome outcome) const { return outcomes[static_cast<std::size_t>(outcome)]; }
  std::optional<double> over_estimate() const;   // Qo; nothing when nothing is visible
  std::optional<double> under_estimate() const;  // Qu
};

// Checks the suite's proof that a triangle is visible, with exact arithmetic (exact/sight/witness.h). Empty, or what is wrong with it: then it is the
// suite that is wrong and not the implementation.
std::string flaw_of_proof(const VectorCase& test, const MustBeVisible& proof);

}  // namespace clues::validate
