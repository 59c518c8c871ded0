// Which way a viewer goes: for `clues walk` and `clues conform --stream-server`.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "app/stream/served_cells.h"

namespace clues::app {

struct RouteChoice {
  std::string route, camera;  // one of them, or
  std::uint64_t steps = 0;    // at random
  std::uint64_t seed = 1;
  std::uint32_t first = 0;  // of the random ones

  void add_to(CLI::App& command, const char* of_steps);  // --route, --camera, --steps, --seed
  bool at_random() const { return route.empty() && camera.empty(); }
  std::string as_options() const;  // to type them again

  // Each step goes to a neighbour. Throws Error bad_argument, malformed, index_out_of_range, non_finite, file errors.
  std::vector<std::uint32_t> take(const ServedCells& served) const;
};

}  // namespace clues::app
