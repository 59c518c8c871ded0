// The error of all readers of motion files: where, and what is wrong.
#pragma once

#include <string>

#include "scene/messages/error.h"

namespace clues::scene {

[[noreturn]] inline void throw_malformed(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::malformed, where + ": " + what);
}

}  // namespace clues::scene
