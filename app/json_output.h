// --json [FILE], the same on every command that has it: alone, or with "-", JSON is printed; with a name it goes into that file, as a whole or not at all.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace clues::app {

class JsonOutput {
 public:
  // `what`: of what, for --help.
  void add_to(CLI::App& command, const std::string& what);

  bool asked() const { return !given_.empty(); }
  bool on_stdout() const { return given_ == "-"; }
  const std::string& file() const;  // empty: none
  void write(const std::string& text) const;

 private:
  std::string given_;  // as the user wrote it; empty: not asked for
};

// Makes each `--json` of a command line one word with its FILE, "--json=FILE", or "--json=-". The word after it is its FILE where that is certain: "-", what ends
// in ".json", and every word that is no option where the command has nothing else that it could be. Throws Error bad_argument for "--json=".
std::vector<std::string> with_json_joined(const CLI::App& program, std::vector<std::string> words);

// What to add to a message about a word that no command expects.
std::string hint_on_json(const std::vector<std::string>& joined);

// Throws Error bad_argument when the output would lie in a folder that this command reads. No file: fine.
void require_outside(const std::string& output, const std::filesystem::path& folder);

}  // namespace clues::app
