// Blocks of cases in parallel; what is counted is counted in order.
#include "validate/conform/runner.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <span>

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

  std::size_t blocks() const { return blocks_.size(); }

  bool is_wanted() {
    const std::lock_guard lock(mutex_);
    return options_.error_limit == 0 || problems_ < options_.error_limit;
  }

  void put(std::size_t block, std::vector<CaseResult> results) {
    const std::lock_guard lock(mutex_);
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
  std::mutex mutex_;
  std::size_t total_, done_ = 0, complete_ = 0;
  std::uint64_t problems_ = 0;
  const Run& run_;
  const RunOptions& options_;
  std::vector<std::optional<std::vector<CaseResult>>> blocks_;
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
  Progress progress(cases.size(), run, options);
  // More jobs than cores are fine: they wait for other processes.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.jobs));
  tbb::task_arena arena(options.jobs);
  arena.execute([&] {
    const tbb::blocked_range<std::size_t> blocks(0, progress.blocks(), 1);
    tbb::parallel_for(
        blocks,
        [&](const auto& range) {
          for (std::size_t block = range.begin(); block != range.end(); ++block) {
            if (!progress.is_wanted()) continue;
            const auto first = block * block_size;
            const std::span block_cases(cases.data() + first, std::min(block_size, cases.size() - first));
            // With as many problems in this block alone, the run ends in it.
            std::uint64_t problems = 0;
            auto answers = subject.answer(block_cases, [&](std::size_t i, const Answer& answer) {
              problems += run.is_problem(grade(*block_cases[i], answer)) ? 1 : 0;
              return options.error_limit == 0 || problems < options.error_limit;
            });
            std::vector<CaseResult> results;
            for (std::size_t i = 0; i < answers.size(); ++i)
              results.push_back(grade(*block_cases[i], std::move(answers[i])));
            progress.put(block, std::move(results));
          }
        },
        tbb::simple_partitioner());
  });
  run.results = progress.take();
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

int exit_code(const Run& run) {
  if (!run.flaws.empty()) return 4;
  if (run.problems() > 0) return 1;
  return run.executed() == 0 || run.unanswered() > 0 ? 3 : 0;
}

}  // namespace clues::validate
