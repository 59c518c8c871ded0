// clues delta detail: added to `clues delta`.
#pragma once

#include <CLI/CLI.hpp>

namespace clues::app {

void add_delta_detail(CLI::App& delta, int& status);  // clues delta detail

}  // namespace clues::app
