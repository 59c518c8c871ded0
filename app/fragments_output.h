// What `clues map --fragments` adds: the visible regions as a sewn mesh, exact (*.json) or rounded (*.obj, *.ply).
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "reference/visibility/map/visibility_map.h"

namespace clues::app {

struct FragmentsRequest {
  std::string file;

  void add_to(CLI::App& command);
};

// Throws Error bad_argument where the options do not fit together, file_unwritable where the file cannot be made.
void require_good(const FragmentsRequest& request, bool many_cells);

struct FragmentsOutput {
  std::string bytes, summary;
};

// The map is in its own range. O(n log n).
FragmentsOutput make_fragments(const reference::VisibilityMap& map, const std::string& scene_path,
                               const std::string& scene_sha256, const FragmentsRequest& request);

}  // namespace clues::app
