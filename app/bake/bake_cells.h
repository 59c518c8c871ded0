// The cells of a bake, as `--cells` names them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/bakes/bake_store.h"
#include "scene/levels/bsp_file.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::app {

struct BakeCells {
  std::vector<scene::BakePlace> cells;
  std::string note;   // what was left out, for a reader; one line
  std::string bytes;  // of the file that lists them, where there is one
};

extern const char* const bake_cells_help;

// "grid:...", "leaves" (of a level), "auto:SIZE[:HEIGHT]", or a file with a cell a line: a name and what --cell takes; # comments, files beside it.
// Throws Error bad_argument, bad_cell, malformed, or a file error.
BakeCells parse_bake_cells(const std::string& text, const std::string& scene_file, const scene::FlaggedMesh& scene,
                           const std::optional<scene::BspFile>& level, char up);

}  // namespace clues::app
