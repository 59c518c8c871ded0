// Long series of scenes, each put to the judge of scenes in a process of its own: a crash, or a scene without end, is a flaw like any other. Flaws are made smaller
// and printed, or written to the file CLUES_FINDINGS; totals are printed at the end. CLUES_THREADS: how many processes; CLUES_SHRUNK: how many flaws of each
// category and dimension of the cell are made smaller (12); CLUES_TIME_FOR_ONE: seconds of processor time for a scene (60).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "tests/differential/scene_judge.h"

namespace clues::tests {

// Scene n is the same in every run; two processes may take halves.
struct Series {
  std::uint64_t seed = 0;
  std::function<fuzz::Case(std::uint64_t seed, std::uint64_t n)> scene;
  std::function<JudgeSettings(std::uint64_t n)> settings;
};

struct Totals {
  std::map<std::string, std::uint64_t> flaws;   // scenes by category of their flaws
  std::map<std::string, std::uint64_t> counts;  // of what was done
};

Totals judge_series(const Series& series, std::uint64_t from, std::uint64_t count);

// Of the environment.
std::uint64_t number_from(const char* variable, std::uint64_t otherwise);

}  // namespace clues::tests
