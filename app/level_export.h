// What `clues level --export` writes: a level as files that the other commands, and other programs, read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/levels/bsp_scene.h"

namespace clues::app {

// scene.obj (all triangles, in the order of their ids), flags.txt (a line each: id, whether it blocks, whether it counts, where it is from), cells.txt (leaf,
// cluster), cells/LEAF.in.obj and LEAF.out.obj (points), pvs/CLUSTER.txt (what was shipped), and last level.json: `about`. The folder is made, or is empty; throws Error
// file_unwritable or bad_argument.
void export_level(const std::filesystem::path& folder, const scene::BspFile& level, const scene::LevelScene& scene,
                  const std::vector<scene::LevelCell>& cells, const std::string& about);

}  // namespace clues::app
