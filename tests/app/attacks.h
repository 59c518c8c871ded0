// A table of attacks: each a row with what is prepared, what is run and what must be true afterwards (attacks/stores.txt says how).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clues::tests {

struct Attack {
  std::string name;
  bool held_before = false;  // against the program of before the table
  std::string make, run, says, check;
  int exit_code = -1;
};

// Throws std::runtime_error with the line that is no row.
std::vector<Attack> read_attacks(const std::filesystem::path& table);

// Runs the row in `folder`; empty, or what went another way. `finding`: the folder of a good one, or empty.
std::string outcome_of(const Attack& attack, const std::filesystem::path& folder, const std::filesystem::path& finding);

}  // namespace clues::tests
