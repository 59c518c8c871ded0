// Runs the built program as a user would: a command line in, exit code and both outputs back. Every test has a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/files/temporary_folder.h"
#include "scene/mesh/mesh.h"
#include "tests/read_all.h"

namespace clues::tests {

struct Ran {
  int exit_code = -1;  // -1: killed by a signal
  std::string out, err;
};

// The built program, or what CLUES_ATTACKED names.
std::string attacked_program();

// `arguments` are given to the program as they are, without a shell.
Ran run_clues(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
// With `more` arguments behind the others.
Ran run_clues(std::vector<std::string> arguments, const std::vector<std::string>& more,
              const std::filesystem::path& folder);
// With this on standard input.
Ran run_clues_on(const std::string& input, const std::vector<std::string>& arguments,
                 const std::filesystem::path& folder);

class TestFolder : public scene::TemporaryFolder {
 public:
  std::string write(const std::string& name, const std::string& bytes) const;  // returns the path
  std::vector<std::string> names() const;                                      // what lies in it, sorted
};

// OFF text: a wall of two triangles (0, 1) at z = 4, and before it at z = 2 a screen (2); seen from a cell near the
// origin the far-off triangle 4 is visible, and triangle 3 just behind the screen is hidden.
extern const char* const screen_scene;
inline constexpr const char* screen_cell = "box:-0.25,-0.25,-0.25,0.25,0.25,0";

}  // namespace clues::tests
