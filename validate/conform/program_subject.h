// A program that speaks JSON lines (docs/protocol.md), as an implementation under test. Every block of cases gets a process of its own, and
// another one after every crash, time-out or reply that is none: whatever the program does is said of the right case.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "validate/conform/subject.h"

namespace clues::validate {

struct ProgramLimits {
  std::chrono::milliseconds time{10000};  // for one case
  std::uint64_t memory_bytes = 0;         // address space; 0: no limit
};

class ProgramSubject : public Subject {
 public:
  // Starts the program once, to hear what it can. Throws scene::Error bad_argument when it cannot be executed or does not answer 'start'.
  ProgramSubject(std::vector<std::string> words, const ProgramLimits& limits);

  const Implementation& about() const override { return about_; }
  std::vector<Answer> answer(std::span<const VectorCase* const> cases, const GoOn& go_on) const override;

 private:
  std::vector<std::string> words_;
  ProgramLimits limits_;
  Implementation about_;
};

// Words of a command line, by the rules of the shell, with its variables and quotes; {scene} is a word like others. Throws scene::Error bad_argument.
std::vector<std::string> split_command(const std::string& command);

// Whether all coordinates of the case are single-precision numbers.
bool is_exact_in_float32(const VectorCase& test);

}  // namespace clues::validate
