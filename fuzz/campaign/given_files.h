// Reads the scenes that a campaign is given: meshes, cases of the conformance suite, and folders of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/generators/given_scenes.h"

namespace clues::fuzz {

// OBJ, OFF, PLY and STL files; vector files (*.json); of a folder all such files, by name, without the index and the schema of a suite. Throws scene::Error
// as the readers do, and bad_argument for a folder that holds none.
GivenScenes read_given_scenes(const std::vector<std::string>& paths);

// The same of levels (.bsp, with the cells of their leaves, outer and inner), glTF scenes (.gltf, .glb) and meshes, in which all triangles block and count; of a
// folder all such files, by name. Throws as read_scene(), and bad_argument for a folder that holds none, or a vector file.
GivenScenes read_given_levels(const std::vector<std::string>& paths);

}  // namespace clues::fuzz
