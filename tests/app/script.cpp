#include "tests/app/script.h"

#include <sys/wait.h>

#include <cstdlib>

#include "tests/app/program.h"

namespace clues::tests {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string script_command(const fs::path& folder, const fs::path& finding, const std::string& script) {
  const std::string prelude = quoted(CLUES_TEST_DATA "/attacks/prelude.sh");
  return "cd " + quoted(folder.string()) + " && export CLUES=" + quoted(attacked_program()) +
         " FINDING=" + quoted(finding.string()) + " SUITE=" + quoted(CLUES_SOURCE_DIR "/vectors") +
         " PYTHON=" + quoted(PYTHON) + " && exec sh -c " + quoted(". " + prelude + "\n" + script);
}

int run_script(const fs::path& folder, const fs::path& finding, const std::string& script, const fs::path& output) {
  const std::string command =
      script_command(folder, finding, script) + " >" + quoted(output.string()) + " 2>&1 </dev/null";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace clues::tests
