// The program `clues`: every subcommand adds itself to it.
#include <algorithm>
#include <cstdio>
#include <string>

#include "app/commands.h"
#include "app/program.h"

namespace {

using namespace clues;

constexpr const char* footer = R"(EXAMPLES
  clues map town.obj --cell box:0,0,1,2,2,2 -o town.clues.json
  clues check town.obj --cell box:0,0,1,2,2,2 --pvs baked.txt
  clues conform --impl 'python3 my_adapter.py'
  clues demo --out demo-out

EXIT CODES
  0  fine
  1  findings: the PVS that was checked is unsound, the implementation fails, or a vector is wrong
  2  bad usage or bad input; nothing was written
  3  not everything could be decided or run
  4  an oracle contradicted itself: a defect of clues, please report it

`clues COMMAND --help` explains each command.)";

// What there is, for who typed `clues` alone.
int list_commands(const CLI::App& program) {
  std::string text = "usage: clues COMMAND ...\n\n";
  for (const auto* command : program.get_subcommands({})) {
    const std::string name = command->get_name();
    text += "  " + name + std::string(std::max<std::size_t>(12, name.size() + 2) - name.size(), ' ') +
            command->get_description() + "\n";
  }
  std::fprintf(stderr, "%s\n`clues COMMAND --help` explains each command, with examples.\n", text.c_str());
  return clues::app::fail("no command; give one of these", clues::app::bad_usage);
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_program();
  CLI::App program{
      "clues - what can be seen from a region of space, exactly.\n"
      "Takes a triangle scene and a convex view cell; computes the first-order visibility map in exact arithmetic, and "
      "judges\n"
      "the potentially visible sets (PVS) of other programs against it.",
      "clues"};
  program.footer(footer);
  program.set_version_flag("--version", "clues " CLUES_VERSION);
  program.require_subcommand(1);
  int status = app::fine;
  app::add_map_command(program, status);
  app::add_bake_command(program, status);
  app::add_precision_command(program, status);
  app::add_check_command(program, status);
  app::add_query_command(program, status);
  app::add_verify_command(program, status);
  app::add_conform_command(program, status);
  app::add_iut_command(program, status);
  app::add_lint_command(program, status);
  app::add_fuzz_commands(program, status);
  app::add_report_command(program, status);
  app::add_level_command(program, status);
  app::add_view_command(program, status);
  app::add_motion_command(program, status);
  app::add_maps_command(program, status);
  app::add_delta_command(program, status);
  app::add_occluders_command(program, status);
  app::add_walk_command(program, status);
  app::add_serve_command(program, status);
  app::add_demo_command(program, status);
  if (argc <= 1) return list_commands(program);
  return app::run_program(program, status, {argv + 1, argv + argc});
}
