// What every door is asked, in the words of the targets.
#pragma once

#include <string>

#include "fuzz/targets/targets.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"

namespace clues::fuzz {

inline void require(bool kept, const std::string& promise) {
  if (!kept) throw BrokenPromise(promise);
}

// Runs `read`; refusing is fine.
template <class Read>
bool accepted(const Read& read) {
  try {
    read();
  } catch (const scene::Error& error) {
    require(error.code() != scene::ErrorCode::internal, std::string("a refusal is no internal error: ") + error.what());
    require(scene::printable(error.what()) == error.what(), "an error is one printable line");
    return false;
  }
  return true;
}

}  // namespace clues::fuzz
