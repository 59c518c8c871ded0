// The one exception type of the library. It is thrown at the boundaries (files, cells, options) and
// carries a code by area, so that a program can map it to an exit status without reading the text.
#pragma once

#include <stdexcept>
#include <string>

#include "scene/messages/printable.h"

namespace clues::scene {

enum class ErrorCode {
  file_not_found = 100,
  file_unreadable = 101,
  file_unwritable = 102,
  malformed = 110,
  unsupported = 111,
  non_finite = 112,
  index_out_of_range = 113,
  bad_cell = 120,
  not_solid = 130,
  bad_argument = 140,
  internal = 900,
};

// what() is one line for a person: file, line or triangle, what is wrong, what to do. It is printable (printable.h)
// whatever the message holds: names and pieces of files go into many of them.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(printable(message)), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace clues::scene
