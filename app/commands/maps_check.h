// The subcommands of `clues maps` that judge.
#pragma once

#include <CLI/CLI.hpp>

namespace clues::app {

void add_maps_check(CLI::App& maps, int& status);  // verify

}  // namespace clues::app
