#pragma once

#include "fastpath/predicates/filter.h"

namespace clues::fastpath {

// A closed axis-aligned box, low <= high.
struct Box {
  Point low{}, high{};
};

}  // namespace clues::fastpath
