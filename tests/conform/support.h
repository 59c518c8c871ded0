// Runs `clues conform` and reads its reports.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace clues::tests {

inline const std::string small_suite = CLUES_TEST_DATA "/suite";
inline const std::string published_suite = CLUES_SOURCE_DIR "/vectors";

// The command line of a planted implementation; with an id it misbehaves in that case only.
std::string planted(const std::string& mode, const std::string& only = "");

struct Conformed {
  Ran ran;
  nlohmann::json report;                        // --json; null when there is none
  std::map<std::string, std::string> outcomes;  // by case id
};

// clues conform --suite SUITE --json ... ARGUMENTS
Conformed conform(const std::vector<std::string>& arguments, const std::string& suite = small_suite);

}  // namespace clues::tests
