// What programs of ours have in common: memory that ends, words that are parsed, and exit codes for what is thrown.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace clues::app {

// One line on standard error; returns `code`.
int fail(const std::string& message, int code);

// Before anything else. Who runs out of memory leaves with one line and exit code 3; warnings go to standard error.
void prepare_program();

// Runs the command that `words` name; returns the exit code: `status`, which the command has set, or that of what it threw.
int run_program(CLI::App& program, const int& status, std::vector<std::string> words);

}  // namespace clues::app
