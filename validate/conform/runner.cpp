// Blocks of cases in parallel; what is counted is counted in order.
#include "validate/conform/runner.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "scene/messages/error.h"
#include "scene/result.h"
#include "validate/processes/thread_pool.h"
#include "validate/vectors/reader.h"

namespace clues::validate {
namespace {

constexpr std::size_t block_size = 16;

template <class Fits>
bool any_or_empty(const std::vector<std::string>& wanted, Fits fits) {
  return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), fits);
}

// Results of blocks as they come, and how many problems the blocks have that are complete from the start on.
class Progress {
 public:
  Progress(std::size_t cases, const Run& run, const RunOptions& options)
      : total_(cases), run_(run), options_(options), blocks_((cases + block_size - 1) / block_size) {}

  bool is_wanted() const { return options_.error_limit == 0 || problems_ < options_.error_limit; }

  void put(std::size_t block, std::vector<CaseResult> results) {
    done_ += results.size();
    blocks_[block] = std::move(results);
    for (; complete_ < blocks_.size() && blocks_[complete_]; ++complete_) {
      problems_ += static_cast<std::uint64_t>(std::count_if(blocks_[complete_]->begin(), blocks_[complete_]->end(),
                                                            [&](const CaseResult& r) { return run_.is_problem(r); }));
    }
    if (options_.progress) options_.progress(done_, total_);
  }

  // In order, up to the problem that reaches the limit.
  std::vector<CaseResult> take() {
    std::vector<CaseResult> results;
    std::uint64_t problems = 0;
    for (auto& block : blocks_) {
      if (!block) break;
      for (auto& result : *block) {
        problems += run_.is_problem(result) ? 1 : 0;
        results.push_back(std::move(result));
        if (options_.error_limit > 0 && problems == options_.error_limit) return results;
      }
    }
    return results;
  }

 private:
  std::size_t total_, done_ = 0, complete_ = 0;
  std::uint64_t problems_ = 0;
  const Run& run_;
  const RunOptions& options_;
  std::vector<std::optional<std::vector<CaseResult>>> blocks_;
};

// Blocks as tasks: a reply is the answers to its cases, which are graded where the run is.
class Blocks {
 public:
  Blocks(const Subject& subject, const std::vector<const VectorCase*>& cases, const Run& run, std::uint64_t error_limit)
      : subject_(subject), cases_(cases), run_(run), error_limit_(error_limit) {}

  std::size_t size() const { return (cases_.size() + block_size - 1) / block_size; }

  std::string plan() const {
    std::string questions;
    for (std::uint32_t i = 0; i < cases_.size(); ++i) questions += cases_[i]->id + run_request(i, *cases_[i]);
    return "clues conform\n" + subject_.about().name + "\n" + subject_.about().version + "\n" +
           scene::sha256_of(questions);
  }

  Work work() const {
    return [this](std::uint64_t block) { return text_of(answers(block)); };
  }

  std::vector<CaseResult> results(std::uint64_t block, const std::string& text) const {
    const auto block_cases = of(block);
    std::vector<CaseResult> results;
    for (const auto& value : nlohmann::json::from_cbor(text)) {
      Answer answer{static_cast<AnswerKind>(value[0].get<int>()), value[1], value[2], value[3], value[4]};
      results.push_back(grade(*block_cases[results.size()], std::move(answer)));
    }
    return results;
  }

 private:
  std::span<const VectorCase* const> of(std::uint64_t block) const {
    const auto first = static_cast<std::size_t>(block) * block_size;
    return std::span(cases_).subspan(first, std::min(block_size, cases_.size() - first));
  }

  std::vector<Answer> answers(std::uint64_t block) const {
    const auto block_cases = of(block);
    // With as many problems in this block alone, the run ends in it.
    std::uint64_t problems = 0;
    return subject_.answer(block_cases, [&](std::size_t i, const Answer& answer) {
      problems += run_.is_problem(grade(*block_cases[i], answer)) ? 1 : 0;
      return error_limit_ == 0 || problems < error_limit_;
    });
  }

  // What programs say may be no UTF-8, which CBOR does not mind.
  static std::string text_of(const std::vector<Answer>& answers) {
    auto values = nlohmann::json::array();
    for (const auto& a : answers)
      values.push_back({static_cast<int>(a.kind), a.visible, a.message, a.issue_url, a.stderr_tail});
    std::string text;
    nlohmann::json::to_cbor(values, text);
    return text;
  }

  const Subject& subject_;
  const std::vector<const VectorCase*>& cases_;
  const Run& run_;
  const std::uint64_t error_limit_;
};

}  // namespace

std::vector<const VectorCase*> select_cases(const std::vector<VectorCase>& suite, const Selection& selection) {
  std::vector<const VectorCase*> fitting;
  for (const auto& test : suite) {
    const bool fits =
        any_or_empty(selection.case_globs, [&](const auto& glob) { return matches_glob(test.id, glob); }) &&
        any_or_empty(selection.topics, [&](const auto& topic) { return test.topic == topic; }) &&
        any_or_empty(selection.flags,
                     [&](const auto& flag) {
                       return std::find(test.flags.begin(), test.flags.end(), flag) != test.flags.end();
                     }) &&
        (!selection.core_only || test.level == CaseLevel::core);
    if (fits) fitting.push_back(&test);
  }
  std::vector<const VectorCase*> chosen;
  for (std::size_t i = selection.shard - 1; i < fitting.size(); i += selection.shards) chosen.push_back(fitting[i]);
  return chosen;
}

const ExpectedFailure* Run::expectation(const CaseResult& result) const {
  const auto found = expected.find(result.test->id);
  return found == expected.end() ? nullptr : &found->second;
}

bool Run::is_expected(const CaseResult& result) const {
  return is_failure(result.outcome) && expectation(result) != nullptr;
}

bool Run::is_surprise(const CaseResult& result) const {
  return (result.outcome == Outcome::tight || result.outcome == Outcome::conservative) &&
         expectation(result) != nullptr;
}

bool Run::is_problem(const CaseResult& result) const {
  return is_surprise(result) || (is_failure(result.outcome) && !is_expected(result));
}

std::uint64_t Run::problems() const {
  return static_cast<std::uint64_t>(
      std::count_if(results.begin(), results.end(), [&](const CaseResult& result) { return is_problem(result); }));
}

std::uint64_t Run::executed() const {
  return static_cast<std::uint64_t>(std::count_if(
      results.begin(), results.end(), [](const CaseResult& result) { return is_executed(result.outcome); }));
}

std::uint64_t Run::unanswered() const {
  return static_cast<std::uint64_t>(std::count_if(
      results.begin(), results.end(), [](const CaseResult& result) { return is_unanswered(result.outcome); }));
}

Run run_cases(const Subject& subject, const std::vector<const VectorCase*>& cases, const RunOptions& options) {
  Run run;
  run.expected = options.expected;
  if (!cases.empty()) {
    Progress progress(cases.size(), run, options);
    const Blocks blocks(subject, cases, run, options.error_limit);
    const auto jobs = std::min(blocks.size(), static_cast<std::size_t>(options.jobs));
    const auto pool = options.pool ? options.pool(blocks.plan(), blocks.work())
                                   : std::make_unique<ThreadPool>(static_cast<int>(jobs), blocks.work());
    for (std::size_t next = 0; true;) {
      while (next < blocks.size() && pool->idle() && progress.is_wanted()) pool->start(next++);
      if (pool->empty()) break;
      auto reply = pool->wait(std::chrono::seconds(10));
      if (!reply) continue;
      if (!reply->finished) throw scene::Error(scene::ErrorCode::internal, reply->text);
      progress.put(static_cast<std::size_t>(reply->task), blocks.results(reply->task, reply->text));
    }
    run.results = progress.take();
  }
  run.not_reached = cases.size() - run.results.size();
  for (const auto& result : run.results) {
    run.total.add(result);
    run.topics[result.test->topic].add(result);
    for (const auto* proof : result.missed) {
      const auto flaw = flaw_of_proof(*result.test, *proof);
      if (!flaw.empty())
        run.flaws.push_back(result.test->id + ", triangle " + std::to_string(proof->triangle) + ": " + flaw);
    }
  }
  return run;
}

void serve_cases(const Subject& subject, const std::vector<const VectorCase*>& cases, const RunOptions& options,
                 const Serve& serve) {
  Run run;
  run.expected = options.expected;
  const Blocks blocks(subject, cases, run, options.error_limit);
  serve(blocks.plan(), blocks.work());
}

int exit_code(const Run& run) {
  if (!run.flaws.empty()) return 4;
  if (run.problems() > 0) return 1;
  return run.executed() == 0 || run.unanswered() > 0 ? 3 : 0;
}

}  // namespace clues::validate
