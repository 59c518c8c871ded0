// The scenes of a campaign by name. Each is a pure function of (seed, index).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/campaign/given_files.h"
#include "fuzz/findings/finding.h"

namespace clues::fuzz {

struct NamedGenerator {
  std::string name;
  std::string degeneracy;  // what it is made to hit, for --help
  std::function<Case(std::uint64_t seed, std::uint64_t index)> make;
};

// `given` must outlive them. mesh_pieces makes something only where a mesh is given.
std::vector<NamedGenerator> all_generators(const GivenScenes& given);

// Those with these names, in the order of all_generators(); without a name all, mesh_pieces only where a mesh is given. NAME:D is a generator with its dial
// at D, 0 to 7 (fuzz/generators/parts.h): its scene n is scene 8 n + D of NAME. Throws scene::Error bad_argument.
std::vector<NamedGenerator> generators_named(const std::vector<std::string>& names, const GivenScenes& given);

}  // namespace clues::fuzz
