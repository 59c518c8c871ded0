// What a run looks like: lines for a person, JSON for a program, JUnit XML for a CI server. The same run gives the same bytes; there are no times in them.
#pragma once

#include <string>

#include "validate/conform/runner.h"

namespace clues::validate {

struct ReportContext {
  Implementation about;
  std::string version;  // of clues
  std::string suite;    // folder
  std::string subject;  // what was tested, as the user gave it: a command, a library or a folder
  std::string repeat;   // command line that repeats the run; the report adds " --case ID"
};

// A table by topic, what went wrong, and a summary. `every_case`: a line for each case first.
std::string to_text(const Run& run, const ReportContext& context, bool every_case);

// Format "clues-conformance/1" (docs/formats.md): keys sorted, two-space indent, newline at the end.
std::string to_json_text(const Run& run, const ReportContext& context);

// One testsuite a topic, one testcase a case. A problem is a failure, a case without an answer an error, a case not put is skipped.
std::string to_junit_text(const Run& run, const ReportContext& context);

// "(1/3, 0, 2)", or "meets the cell".
std::string proof_text(const MustBeVisible& proof);

// One line about the result: what is missed and the first witness, what was answered instead of a PVS, or how much is too much.
std::string describe(const Run& run, const CaseResult& result);

}  // namespace clues::validate
