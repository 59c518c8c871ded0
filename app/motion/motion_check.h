// The judging half of `clues motion`: check, verify and conform, added to the subcommand that command_motion.cpp makes.
#pragma once

#include <CLI/CLI.hpp>

namespace clues::app {

void add_motion_check(CLI::App& motion, int& status);

}  // namespace clues::app
