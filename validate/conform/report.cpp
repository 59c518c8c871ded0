// The table and the failure lines of `clues conform`.
#include "validate/conform/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "scene/messages/printable.h"

namespace clues::validate {
namespace {

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string ratio_text(const std::optional<double>& ratio) { return ratio ? fmt::format("{:.3f}", *ratio) : "-"; }

std::string point_text(const RationalPoint& p) { return fmt::format("({}, {}, {})", p[0], p[1], p[2]); }

std::string row(const std::string& name, const Tally& tally, std::size_t width) {
  std::uint64_t failed = 0, unanswered = 0;
  for (const auto outcome : {Outcome::malformed_output, Outcome::crash, Outcome::timeout}) failed += tally.of(outcome);
  for (const auto outcome : {Outcome::errored, Outcome::resource}) unanswered += tally.of(outcome);
  const auto skipped = tally.of(Outcome::unsupported) + tally.of(Outcome::skipped) + tally.of(Outcome::rejected_input);
  return fmt::format("{:<{}}  {:>5}  {:>5}  {:>12}  {:>7}  {:>6}  {:>10}  {:>7}  {:>8}  {:>8}  {:>6}\n", name, width,
                     tally.cases, tally.of(Outcome::tight), tally.of(Outcome::conservative), tally.of(Outcome::unsound),
                     failed, unanswered, skipped, ratio_text(tally.over_estimate()), ratio_text(tally.under_estimate()),
                     tally.looser);
}

std::string table(const Run& run) {
  std::size_t width = 5;
  for (const auto& [topic, tally] : run.topics) width = std::max(width, topic.size());
  auto text =
      fmt::format("{:<{}}  {:>5}  {:>5}  {:>12}  {:>7}  {:>6}  {:>10}  {:>7}  {:>8}  {:>8}  {:>6}\n", "topic", width,
                  "cases", "tight", "conservative", "unsound", "failed", "unanswered", "skipped", "Qo", "Qu", "looser");
  for (const auto& [topic, tally] : run.topics) text += row(topic, tally, width);
  return text + row("total", run.total, width);
}

std::string indented(const std::string& text, const char* indent) {
  std::string out = indent;
  for (const char c : text) {
    out += c;
    if (c == '\n') out += indent;
  }
  return out + "\n";
}

std::string problem_text(const Run& run, const CaseResult& result, const ReportContext& context) {
  const bool surprise = run.is_surprise(result);
  auto text = fmt::format("{} {}: {}\n", surprise ? "PASSES" : upper_case(to_string(result.outcome)), result.test->id,
                          describe(run, result));
  constexpr std::size_t shown = 4;
  for (std::size_t i = 1; i < std::min(result.missed.size(), shown); ++i) {
    text += fmt::format("  missed too: {}\n", proof_text(*result.missed[i]));
  }
  if (result.missed.size() > shown) text += fmt::format("  and {} more (see --json)\n", result.missed.size() - shown);
  if (!result.answer.stderr_tail.empty()) text += "  standard error:\n" + indented(result.answer.stderr_tail, "    ");
  return text + fmt::format("  repeat: {} --case {}\n", context.repeat, result.test->id);
}

std::string summary(const Run& run) {
  const auto& total = run.total;
  std::uint64_t expected = 0, surprises = 0;
  for (const auto& result : run.results) {
    expected += run.is_expected(result) ? 1 : 0;
    surprises += run.is_surprise(result) ? 1 : 0;
  }
  auto text = fmt::format("{} cases: {} executed", run.results.size(), run.executed());
  for (std::size_t i = 0; i < outcome_count; ++i) {
    if (total.outcomes[i] > 0) text += fmt::format(", {} {}", total.outcomes[i], to_string(static_cast<Outcome>(i)));
  }
  if (expected > 0) text += fmt::format("; {} failed as expected", expected);
  if (surprises > 0) text += fmt::format("; {} expected to fail did not", surprises);
  if (run.not_reached > 0) text += fmt::format("; {} not reached (--errors)", run.not_reached);
  text += "\n";
  if (total.exact > 0) {
    text += fmt::format(
        "overestimate Qo = {}, underestimate Qu = {}: {} triangles too many, {} missing, of {} visible ones\n",
        ratio_text(total.over_estimate()), ratio_text(total.under_estimate()), total.extra, total.missed, total.exact);
  }
  if (total.within_first_order + total.looser > 0) {
    text += fmt::format("within the first-order visible set: {} answers of {}\n", total.within_first_order,
                        total.within_first_order + total.looser);
  }
  return text;
}

}  // namespace

std::string proof_text(const MustBeVisible& proof) {
  if (proof.meets_cell) return fmt::format("triangle {} meets the cell", proof.triangle);
  return fmt::format("triangle {}, {} side, seen along {} - {}", proof.triangle, proof.front ? "front" : "back",
                     point_text(proof.v), point_text(proof.p));
}

std::string describe(const Run& run, const CaseResult& result) {
  if (run.is_surprise(result)) {
    const auto& entry = *run.expectation(result);
    return fmt::format("expected to fail since {} ({}), and does not any more; take the entry out", entry.date,
                       scene::printable(entry.issue));
  }
  if (!result.has_pvs()) {
    const auto& answer = result.answer;
    constexpr std::size_t shown = 1000;
    return scene::printable(answer.message, shown) +
           (answer.issue_url.empty() ? "" : " (" + scene::printable(answer.issue_url, shown) + ")");
  }
  if (!result.missed.empty()) {
    return fmt::format("missed={}; {}", result.missed.size(), proof_text(*result.missed.front()));
  }
  const auto exact = result.test->expect->must_be_visible.size();
  auto text = fmt::format("{} visible", exact);
  if (!result.extra.empty()) text += fmt::format(", {} listed without being visible", result.extra.size());
  if (!result.out_of_first_order.empty()) {
    text += fmt::format(", {} of them not even first-order visible", result.out_of_first_order.size());
  }
  return text;
}

std::string to_text(const Run& run, const ReportContext& context, bool every_case) {
  auto text = fmt::format("implementation: {}{}{} ({})\nsuite: {}\n\n", scene::printable(context.about.name),
                          context.about.version.empty() ? "" : " ", scene::printable(context.about.version),
                          scene::printable(context.subject), scene::printable(context.suite));
  if (every_case) {
    for (const auto& result : run.results) {
      text += fmt::format("{:<16} {}{}: {}\n", to_string(result.outcome), result.test->id,
                          run.is_expected(result) ? " (expected)" : "", describe(run, result));
    }
    text += "\n";
  }
  text += table(run) + "\n";
  for (const auto& result : run.results) {
    if (run.is_problem(result)) text += problem_text(run, result, context);
    if (is_unanswered(result.outcome)) text += problem_text(run, result, context);
  }
  for (const auto& flaw : run.flaws) text += "THE SUITE IS WRONG: " + flaw + "\n";
  return text + summary(run);
}

}  // namespace clues::validate
