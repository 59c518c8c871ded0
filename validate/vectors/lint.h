// `clues lint`: is the suite what it says it is? Files parse and have the one canonical text, ids are unique and never disappear, counts
// agree, and every expectation is proved anew (prove.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "validate/processes/work_pool.h"
#include "validate/vectors/prove.h"

namespace clues::validate {

struct LintOptions {
  std::string glob = "*";  // only the cases whose id matches are proved; files and index are always looked at
  bool write = false;      // write files canonically, fill in missing expectations and bring the index up to date
  bool accept = false;     // with write: also replace expectations that turned out wrong
  int jobs = 1;            // child processes
  PoolMaker pool;          // that prove cases; none: `jobs` child processes of this machine
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

// unfinished: the process that proved it was killed from outside, for want of memory for instance.
enum class LintKind { malformed, wrong, unfinished, contradiction };

struct LintFinding {
  LintKind kind = LintKind::wrong;
  std::string file, case_id, field, message;  // case_id and field may be empty
};

struct LintReport {
  std::vector<LintFinding> findings;               // by file and case, in the order of the suite
  std::vector<std::string> changes;                // what --write changed in expectations, or would with --accept
  std::vector<std::string> written;                // files
  std::uint64_t files = 0, cases = 0, proved = 0;  // cases in the suite; cases matched by glob and without finding
  std::uint64_t selected = 0;
  CaseProofs proofs;  // sums; its findings are empty
};

// Throws Error file_not_found when there is no such folder, file_unwritable with `write`.
LintReport lint_suite(const std::filesystem::path& folder, const LintOptions& options);

// Of another machine: proves the cases that it is given, and writes nothing.
void serve_lint(const std::filesystem::path& folder, const LintOptions& options, const Serve& serve);

std::string to_text(const LintReport& report);
// "clues-lint/1": keys sorted, two spaces of indent, newline at the end.
std::string to_json_text(const LintReport& report);

}  // namespace clues::validate
