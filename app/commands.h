// The subcommands. Each adds itself to the program and, when chosen, leaves its exit code in `status`.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace clues::app {

// docs/interpreting-results.md and every --help say the same.
enum ExitCode : int { fine = 0, findings = 1, bad_usage = 2, not_everything_ran = 3, oracle_contradiction = 4 };

// Thrown where not everything could be done, though nothing is wrong: exit code 3.
struct Unfinished : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void add_level_command(CLI::App& program, int& status);
void add_map_command(CLI::App& program, int& status);
void add_bake_command(CLI::App& program, int& status);
void add_precision_command(CLI::App& program, int& status);
void add_check_command(CLI::App& program, int& status);
void add_query_command(CLI::App& program, int& status);
void add_verify_command(CLI::App& program, int& status);
void add_conform_command(CLI::App& program, int& status);
void add_iut_command(CLI::App& program, int& status);
void add_lint_command(CLI::App& program, int& status);
void add_fuzz_commands(CLI::App& program, int& status);  // fuzz, replay, shrink
void add_report_command(CLI::App& program, int& status);
void add_view_command(CLI::App& program, int& status);
void add_motion_command(CLI::App& program, int& status);  // and motion check, motion verify
void add_maps_command(CLI::App& program, int& status);    // and maps verify
void add_delta_command(CLI::App& program, int& status);   // and delta check
void add_occluders_command(CLI::App& program, int& status);
void add_walk_command(CLI::App& program, int& status);
void add_serve_command(CLI::App& program, int& status);
void add_demo_command(CLI::App& program, int& status);

}  // namespace clues::app
