#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "fuzz/findings/finding.h"

namespace clues::fuzz {

// Cases by name. Each is a pure function of (seed, index).
struct NamedGenerator {
  std::string name;
  std::string degeneracy;  // what it is made to hit, for --help
  std::function<Case(std::uint64_t seed, std::uint64_t index)> make;
  std::string missing{};  // what has to be given before it can make anything; empty: nothing
};

}  // namespace clues::fuzz
