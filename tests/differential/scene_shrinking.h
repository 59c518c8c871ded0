// Scenes with a flaw, made small and written down.
#pragma once

#include <string>

#include "tests/differential/scene_judge.h"

namespace clues::tests {

// Without the triangles, and then the corners of the cell, that the flaw does not need.
fuzz::Case shrunk(const fuzz::Case& scene, const JudgeSettings& settings, const std::string& category);

// The scene as an OBJ file, and the cell as `--cell` takes it: "box:..." where it is one, else another OBJ.
std::string to_obj_text(const fuzz::Case& scene);

}  // namespace clues::tests
