// Apart from subject.cpp, which needs all of clues.
#include <algorithm>
#include <array>

#include "fuzz/subjects/subject.h"

namespace clues::fuzz {

bool is_program(const std::string& text) {
  constexpr std::array names{"reference",         "fast", "subdivided", "backprojected", "fast:subdivided",
                             "fast:backprojected"};
  return std::find(names.begin(), names.end(), text) == names.end();
}

}  // namespace clues::fuzz
