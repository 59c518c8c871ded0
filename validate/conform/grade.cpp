// Set differences of sorted lists.
#include "validate/conform/grade.h"

#include <algorithm>
#include <utility>

namespace clues::validate {
namespace {

bool holds(const std::vector<std::uint32_t>& sorted, std::uint32_t id) {
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

Outcome outcome_of(AnswerKind kind) {
  switch (kind) {
    case AnswerKind::visible:
      return Outcome::tight;
    case AnswerKind::unsupported:
      return Outcome::unsupported;
    case AnswerKind::skipped:
      return Outcome::skipped;
    case AnswerKind::rejected_input:
      return Outcome::rejected_input;
    case AnswerKind::malformed_output:
      return Outcome::malformed_output;
    case AnswerKind::errored:
      return Outcome::errored;
    case AnswerKind::crash:
      return Outcome::crash;
    case AnswerKind::timeout:
      return Outcome::timeout;
    case AnswerKind::resource:
      break;
  }
  return Outcome::resource;
}

}  // namespace

const char* to_string(Outcome outcome) {
  constexpr const char* names[outcome_count] = {"tight",   "conservative",   "unsound",          "unsupported",
                                                "skipped", "rejected_input", "malformed_output", "errored",
                                                "crash",   "timeout",        "resource"};
  return names[static_cast<std::size_t>(outcome)];
}

bool is_failure(Outcome outcome) {
  return outcome == Outcome::unsound || outcome == Outcome::malformed_output || outcome == Outcome::crash ||
         outcome == Outcome::timeout;
}

bool is_unanswered(Outcome outcome) { return outcome == Outcome::errored || outcome == Outcome::resource; }

bool is_executed(Outcome outcome) {
  return outcome == Outcome::tight || outcome == Outcome::conservative || is_failure(outcome);
}

CaseResult grade(const VectorCase& test, Answer answer) {
  CaseResult result;
  result.test = &test;
  result.answer = std::move(answer);
  result.outcome = outcome_of(result.answer.kind);
  if (!result.has_pvs()) return result;
  const auto& listed = result.answer.visible;
  const auto& expect = *test.expect;
  for (const auto& proof : expect.must_be_visible) {
    if (!holds(listed, proof.triangle)) result.missed.push_back(&proof);
  }
  for (const auto& umbra : expect.umbra) {
    if (holds(listed, umbra.triangle)) result.extra.push_back(umbra.triangle);
  }
  for (const auto id : listed) {
    if (!test.counts.empty() && test.counts[id] == 0) continue;  // nobody asked
    if (!holds(expect.first_order_visible, id) && !holds(expect.no_surface, id))
      result.out_of_first_order.push_back(id);
  }
  if (!result.extra.empty()) result.outcome = Outcome::conservative;
  if (!result.missed.empty()) result.outcome = Outcome::unsound;
  return result;
}

void Tally::add(const CaseResult& result) {
  ++cases;
  ++outcomes[static_cast<std::size_t>(result.outcome)];
  if (!result.has_pvs()) return;
  exact += result.test->expect->must_be_visible.size();
  extra += result.extra.size();
  missed += result.missed.size();
  ++(result.out_of_first_order.empty() ? within_first_order : looser);
}

std::optional<double> Tally::over_estimate() const {
  if (exact == 0) return std::nullopt;
  return static_cast<double>(extra) / static_cast<double>(exact);
}

std::optional<double> Tally::under_estimate() const {
  if (exact == 0) return std::nullopt;
  return static_cast<double>(missed) / static_cast<double>(exact);
}

}  // namespace clues::validate
