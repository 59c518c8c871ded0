// Puts a selection of the suite to an implementation. The result depends on the selection and the implementation alone, not on the number of
// jobs: cases go in blocks of fixed size, each to a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "validate/conform/expected_failures.h"
#include "validate/conform/grade.h"
#include "validate/conform/subject.h"
#include "validate/processes/work_pool.h"

namespace clues::validate {

// Each list: empty means all; otherwise one of its entries must fit.
struct Selection {
  std::vector<std::string> case_globs, flags, topics;
  bool core_only = false;
  std::uint32_t shard = 1, shards = 1;  // of what is left, every shards-th case, beginning with number `shard`
};

std::vector<const VectorCase*> select_cases(const std::vector<VectorCase>& suite, const Selection& selection);

struct RunOptions {
  int jobs = 1;                   // blocks at a time
  PoolMaker pool;                 // that puts blocks; none: `jobs` threads of this process
  std::uint64_t error_limit = 0;  // stop after so many problems; 0: never
  ExpectedFailures expected;
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // from one thread at a time
};

struct Run {
  std::vector<CaseResult> results;  // in the order of the cases; with an error_limit perhaps not all of them
  std::uint64_t not_reached = 0;    // cases after the limit
  ExpectedFailures expected;        // as given
  Tally total;
  std::map<std::string, Tally> topics;
  std::vector<std::string> flaws;  // of the suite itself: proofs of missed triangles that do not hold. Must stay empty

  const ExpectedFailure* expectation(const CaseResult& result) const;
  bool is_expected(const CaseResult& result) const;  // fails, as it was listed to
  bool is_surprise(const CaseResult& result) const;  // listed to fail, and is sound
  bool is_problem(const CaseResult& result) const;   // fails unexpectedly, or is a surprise
  std::uint64_t problems() const;
  std::uint64_t executed() const;
  std::uint64_t unanswered() const;
};

Run run_cases(const Subject& subject, const std::vector<const VectorCase*>& cases, const RunOptions& options);

// Of another machine: puts the blocks that it is given, of the same selection.
void serve_cases(const Subject& subject, const std::vector<const VectorCase*>& cases, const RunOptions& options,
                 const Serve& serve);

// 0 no problem, 1 a problem, 3 nothing was executed or a case was left unanswered, 4 the suite contradicts itself.
int exit_code(const Run& run);

}  // namespace clues::validate
