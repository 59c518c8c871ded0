// The list of cases that an implementation is known to fail: strict, so that it cannot outlive the defects that it excuses.
//
//   {"format": "clues-expected-failures/1",
//    "cases": [{"case": "wall-one-ulp-gap", "issue": "https://example.org/issues/17", "date": "2026-11-21"}]}
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "validate/vectors/suite.h"

namespace clues::validate {

struct ExpectedFailure {
  std::string issue;  // http:// or https://
  std::string date;   // YYYY-MM-DD
};

using ExpectedFailures = std::map<std::string, ExpectedFailure>;  // by case id

// Throws scene::Error: file_not_found, malformed (syntax, unknown field, no such day, an id twice, an id that no case of the suite has).
ExpectedFailures read_expected_failures(const std::filesystem::path& file, const std::vector<VectorCase>& suite);

}  // namespace clues::validate
