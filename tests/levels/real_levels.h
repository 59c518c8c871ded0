// The levels of OpenArena, which nobody here made: Debian's package openarena-081-maps, or what CLUES_LEVELS names.
#pragma once

#include <filesystem>
#include <string>

#include "tests/app/program.h"

namespace clues::tests {

struct RealLevels {
  std::filesystem::path folder;  // of *.bsp; empty: there are none
  std::string why_not;           // what to install or set
};

// Unpacked into the test's folder, where they come from the package.
RealLevels real_levels(const TestFolder& folder);

}  // namespace clues::tests
