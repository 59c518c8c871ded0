// The scenes of a campaign by name. Each is a pure function of (seed, index).
#pragma once

#include <string>
#include <vector>

#include "fuzz/campaign/given_files.h"
#include "fuzz/findings/named_generator.h"

namespace clues::fuzz {

// `given` must outlive them. mesh_pieces makes something only where a mesh is given.
std::vector<NamedGenerator> all_generators(const GivenScenes& given);

// Those with these names, in the order of all_generators(); without a name all, mesh_pieces only where a mesh is given. NAME:D is a generator with its dial
// at D, 0 to 7 (fuzz/generators/parts.h): its scene n is scene 8 n + D of NAME. Throws scene::Error bad_argument.
std::vector<NamedGenerator> generators_named(const std::vector<std::string>& names, const GivenScenes& given);

}  // namespace clues::fuzz
