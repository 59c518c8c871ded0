// clues check --all-cells: what was baked, or shipped with a level, cell by cell.
#pragma once

#include <optional>
#include <string>

#include "app/json_output.h"

namespace clues::app {

struct CheckCellsRequest {
  std::string scene, bake;  // bake: a store of `clues bake`, or none: the lists that a level was shipped with
  int threads = 0;
  bool sight_lines_only = false;  // without the kernel
  std::optional<double>
      far_plane;  // what is farther away a list need not hold; 0: it must. None: what the level says of its own lists
  JsonOutput json;
};

// Throws Error bad_argument for what is no distance.
void require_far_plane(const std::optional<double>& far_plane);

// The exit code.
int check_all_cells(const CheckCellsRequest& request);

}  // namespace clues::app
