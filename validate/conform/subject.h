// An implementation under test, whichever way it is reached: result files (result_files.h), or a program (program_subject.h), which may be
// `clues iut --library`, speaking for a shared library.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "validate/conform/protocol.h"
#include "validate/vectors/suite.h"

namespace clues::validate {

class Subject {
 public:
  virtual ~Subject() = default;

  virtual const Implementation& about() const = 0;

  // Told after each case; false: the cases that follow need not be put any more.
  using GoOn = std::function<bool(std::size_t i, const Answer& answer)>;

  // The answers to some cases, in their order, up to where go_on said no. A later answer may still change the one before it (a reply too many). What
  // is asked in one call does not depend on any other call; called from many threads.
  virtual std::vector<Answer> answer(std::span<const VectorCase* const> cases, const GoOn& go_on) const = 0;
};

}  // namespace clues::validate
