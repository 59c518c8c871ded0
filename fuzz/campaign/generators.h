// The scenes of a campaign by name. Each is a pure function of (seed, index).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/campaign/finding.h"

namespace clues::fuzz {

struct NamedGenerator {
  std::string name;
  std::string degeneracy;  // what it is made to hit, for --help
  std::function<Case(std::uint64_t seed, std::uint64_t index)> make;
};

const std::vector<NamedGenerator>& all_generators();

// Those with these names, in the order of all_generators(); all of them when there is no name. Throws scene::Error bad_argument.
std::vector<NamedGenerator> generators_named(const std::vector<std::string>& names);

}  // namespace clues::fuzz
