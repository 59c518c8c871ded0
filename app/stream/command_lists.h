// clues delta lists: added to `clues delta`.
#pragma once

#include <CLI/CLI.hpp>

namespace clues::app {

void add_delta_lists(CLI::App& delta, int& status);

}  // namespace clues::app
