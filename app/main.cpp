// The program `clues`: parses the command line, hands over to one subcommand, and turns what is thrown into exit codes.
#include <gmp.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/json_output.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/messages/warning.h"

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

// Messages quote names and files: one line, without anything that a terminal would obey.
int fail(const std::string& message, int code) {
  std::fprintf(stderr, "clues: error: %s\n", scene::printable(message).c_str());
  return code;
}

// What there is, for who typed `clues` alone.
int list_commands(const CLI::App& program) {
  std::string text = "usage: clues COMMAND ...\n\n";
  for (const auto* command : program.get_subcommands({})) {
    const std::string name = command->get_name();
    text += "  " + name + std::string(std::max<std::size_t>(12, name.size() + 2) - name.size(), ' ') +
            command->get_description() + "\n";
  }
  std::fprintf(stderr, "%s\n`clues COMMAND --help` explains each command, with examples.\n", text.c_str());
  return fail("no command; give one of these", clues::app::bad_usage);
}

// GMP would abort, and an exception must not pass through its frames. Files are written as a whole or not at all, so leaving at once is safe.
[[noreturn]] void leave_without_memory() {
  constexpr char message[] = "clues: error: out of memory\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  ::_exit(clues::app::not_everything_ran);
}

void* allocate_or_leave(std::size_t size) {
  void* memory = std::malloc(size);
  return memory ? memory : (leave_without_memory(), nullptr);
}

void* reallocate_or_leave(void* old, std::size_t, std::size_t size) {
  void* memory = std::realloc(old, size);
  return memory ? memory : (leave_without_memory(), nullptr);
}

void release(void* memory, std::size_t) { std::free(memory); }

// Where memory ends within something that may not throw.
[[noreturn]] void on_terminate() {
  try {
    if (const auto problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::bad_alloc&) {
    leave_without_memory();
  } catch (...) {
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(on_terminate);
  mp_set_memory_functions(allocate_or_leave, reallocate_or_leave, release);
  scene::warning_listener() = [](const std::string& warning) {
    std::fprintf(stderr, "clues: warning: %s\n", scene::printable(warning).c_str());
  };
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
  std::vector<std::string> words(argv + 1, argv + argc);
  try {
    words = app::with_json_joined(program, std::move(words));
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("cannot write to standard output", app::bad_usage);
    return status;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);  // --help, --version
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr;
    return fail(e.what() + (extra ? app::hint_on_json(words) : "") + " (see `clues --help`)", app::bad_usage);
  } catch (const scene::Error& e) {
    return fail(e.what(), e.code() == scene::ErrorCode::internal ? app::oracle_contradiction : app::bad_usage);
  } catch (const app::Unfinished& e) {
    return fail(e.what(), app::not_everything_ran);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", app::not_everything_ran);
  } catch (const std::filesystem::filesystem_error& e) {
    return fail(e.path1().string() + ": " + e.code().message(), app::bad_usage);
  } catch (const std::system_error& e) {
    return fail(e.what(), app::not_everything_ran);
  } catch (const std::exception& e) {
    return fail(std::string("internal: ") + e.what(), app::oracle_contradiction);
  }
}
