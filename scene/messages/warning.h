// What a reader leaves out, though the file has it, is said: to whoever listens, in this process `clues` itself, which writes it to standard error.
#pragma once

#include <functional>
#include <string>

namespace clues::scene {

// One line for a person, as the text of an Error. To be set before any reader runs; without it warnings go nowhere.
using WarningListener = std::function<void(const std::string& warning)>;

inline WarningListener& warning_listener() {
  static WarningListener listener;
  return listener;
}

inline void warn(const std::string& warning) {
  if (warning_listener()) warning_listener()(warning);
}

}  // namespace clues::scene
