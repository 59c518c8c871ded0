// clues check --all-cells: what was baked, or shipped with a level, cell by cell.
#pragma once

#include <string>

#include "app/json_output.h"

namespace clues::app {

struct CheckCellsRequest {
  std::string scene, bake;  // bake: a store of `clues bake`, or none: the lists that a level was shipped with
  int threads = 0;
  bool sight_lines_only = false;  // without the kernel
  JsonOutput json;
};

// The exit code.
int check_all_cells(const CheckCellsRequest& request);

}  // namespace clues::app
