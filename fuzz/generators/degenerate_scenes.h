// Small scenes each made to hit one named degeneracy (definition, section 5): what is equal, coplanar, thin or nearly closed on purpose.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/generators/random_scenes.h"

namespace clues::fuzz {

struct DegenerateGenerator {
  const char* name;
  const char* what;  // one line
  GeneratedScene (*make)(std::uint64_t seed, std::uint64_t index);
};

// Each a pure function of seed and index: at most 80 triangles, finite coordinates; only slivers have triangles without area. The strength of the
// degeneracy, where there is a dial, is dial_of(index).
const std::vector<DegenerateGenerator>& degenerate_generators();

}  // namespace clues::fuzz
