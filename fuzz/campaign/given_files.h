// Reads the scenes that a campaign is given: meshes, cases of the conformance suite, and folders of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/generators/given_scenes.h"

namespace clues::fuzz {

struct GivenScenes {
  std::vector<GivenScene> meshes;  // of more than 40 triangles
  std::vector<GivenScene> small;
  std::vector<std::string> paths;  // as they were given
  std::string hashes;              // SHA-256 of each file, in the order of reading
};

// OBJ, OFF, PLY and STL files; vector files (*.json); of a folder all such files, by name, without the index and the schema of a suite. Throws scene::Error
// as the readers do, and bad_argument for a folder that holds none.
GivenScenes read_given_scenes(const std::vector<std::string>& paths);

}  // namespace clues::fuzz
