#include "app/program.h"

#include <gmp.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "app/commands.h"
#include "app/json_output.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "scene/messages/warning.h"

namespace clues::app {
namespace {

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

// Messages quote names and files: one line, without anything that a terminal would obey.
int fail(const std::string& message, int code) {
  std::fprintf(stderr, "clues: error: %s\n", scene::printable(message).c_str());
  return code;
}

void prepare_program() {
  std::set_terminate(on_terminate);
  mp_set_memory_functions(allocate_or_leave, reallocate_or_leave, release);
  scene::warning_listener() = [](const std::string& warning) {
    std::fprintf(stderr, "clues: warning: %s\n", scene::printable(warning).c_str());
  };
}

int run_program(CLI::App& program, const int& status, std::vector<std::string> words) {
  try {
    words = with_json_joined(program, std::move(words));
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("cannot write to standard output", bad_usage);
    return status;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);  // --help, --version
    const bool extra = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr;
    return fail(e.what() + (extra ? hint_on_json(words) : "") + " (see `clues --help`)", bad_usage);
  } catch (const scene::Error& e) {
    return fail(e.what(), e.code() == scene::ErrorCode::internal ? oracle_contradiction : bad_usage);
  } catch (const Unfinished& e) {
    return fail(e.what(), not_everything_ran);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", not_everything_ran);
  } catch (const std::filesystem::filesystem_error& e) {
    return fail(e.path1().string() + ": " + e.code().message(), bad_usage);
  } catch (const std::system_error& e) {
    return fail(e.what(), not_everything_ran);
  } catch (const std::exception& e) {
    return fail(std::string("internal: ") + e.what(), oracle_contradiction);
  }
}

}  // namespace clues::app
