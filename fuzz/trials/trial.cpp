#include "fuzz/trials/trial.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

template <class Named>
std::vector<Named> those_named(const std::vector<Named>& all, const std::vector<std::string>& names,
                               const char* option) {
  for (const std::string& name : names) {
    if (std::none_of(all.begin(), all.end(), [&](const Named& n) { return n.name == name; }))
      throw scene::Error(
          scene::ErrorCode::bad_argument,
          fmt::format("{} {}: this subject has none of this name; `clues fuzz --help` lists them", option, name));
  }
  std::vector<Named> chosen;
  for (const Named& n : all) {
    if (names.empty() || std::find(names.begin(), names.end(), n.name) != names.end()) chosen.push_back(n);
  }
  return chosen;
}

}  // namespace

std::vector<Trial::Check> checks_named(const Trial& trial, const std::vector<std::string>& names) {
  return those_named(trial.checks(), names, "--oracle");
}

std::vector<NamedGenerator> generators_named(const Trial& trial, const std::vector<std::string>& names,
                                             const std::vector<Trial::Check>& checks, const GivenScenes& given) {
  auto chosen = those_named(trial.generators(given), names, "--generator");
  const auto is_idle = [&](const NamedGenerator& g) {
    return std::none_of(checks.begin(), checks.end(),
                        [&](const Trial::Check& check) { return trial.looks_at(check.name, g.name); });
  };
  const auto idle = std::find_if(chosen.begin(), chosen.end(), is_idle);
  if (!names.empty() && idle != chosen.end())
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--generator {}: none of the oracles that are asked for looks at it", idle->name));
  const auto missing = std::find_if(chosen.begin(), chosen.end(), [](const auto& g) { return !g.missing.empty(); });
  if (!names.empty() && missing != chosen.end())
    throw scene::Error(scene::ErrorCode::bad_argument,
                       fmt::format("--generator {}: give {} with --scenes", missing->name, missing->missing));
  std::erase_if(chosen, [&](const NamedGenerator& g) { return is_idle(g) || !g.missing.empty(); });
  return chosen;
}

Outcome judge_case(const Case& scene, const Trial& trial, const std::vector<Trial::Check>& checks) {
  Outcome outcome;
  outcome.counters["cases of " + scene.generator] = 1;
  std::vector<std::string> asked;
  for (const auto& check : checks) asked.emplace_back(check.name);
  try {
    trial.judge(scene, asked, outcome);
  } catch (const scene::Error& error) {
    outcome.findings.push_back(without_answer(scene, error.what()));
  }
  return outcome;
}

std::optional<Finding> Trial::found_again(const Finding& finding, const Case& scene) const {
  Outcome outcome;
  if (finding.oracle == "subject") {  // it gave no answer
    outcome = judge_case(scene, *this, checks());
  } else {
    judge(scene, {finding.oracle}, outcome);
  }
  for (Finding& f : outcome.findings) {
    if (f.oracle == finding.oracle && f.verdict == finding.verdict) return std::move(f);
  }
  return std::nullopt;
}

void file(const Case& scene, const char* check, const std::string& wrong, Outcome& outcome) {
  if (wrong.empty()) return;
  Finding f;
  f.oracle = check;
  f.verdict = broken_promise;
  f.where = scene;
  f.explanation = wrong.substr(0, wrong.find('\n'));
  outcome.findings.push_back(std::move(f));
}

bool is_asked(const std::vector<std::string>& asked, const char* check) {
  return std::find(asked.begin(), asked.end(), check) != asked.end();
}

}  // namespace clues::fuzz
