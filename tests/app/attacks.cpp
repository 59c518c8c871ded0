#include "tests/app/attacks.h"

#include <fstream>
#include <stdexcept>

#include "tests/app/program.h"
#include "tests/app/script.h"

namespace clues::tests {
namespace fs = std::filesystem;

std::vector<Attack> read_attacks(const fs::path& table) {
  std::vector<Attack> all;
  std::ifstream in(table);
  std::string* open = nullptr;  // a field may have several lines
  for (std::string line; std::getline(in, line);) {
    const auto space = line.find(' ');
    const std::string word = line.substr(0, space), rest = space == line.npos ? "" : line.substr(space + 1);
    if (line.empty() || line[0] == '#') {
      open = nullptr;
    } else if (word == "attack") {
      const auto end = rest.find(' ');
      if (end == rest.npos) throw std::runtime_error("failed or held? " + line);
      all.emplace_back();
      all.back().name = rest.substr(0, end);
      all.back().held_before = rest.substr(end + 1) == "held";
      open = nullptr;
    } else if (word == "exit" && !all.empty()) {
      all.back().exit_code = std::stoi(rest);
    } else if ((word == "make" || word == "run" || word == "says" || word == "check") && !all.empty()) {
      Attack& last = all.back();
      open = word == "make" ? &last.make : word == "run" ? &last.run : word == "says" ? &last.says : &last.check;
      *open = rest;
    } else if (open != nullptr) {
      *open += "\n" + line;
    } else {
      throw std::runtime_error("no row: " + line);
    }
  }
  return all;
}

std::string outcome_of(const Attack& attack, const fs::path& folder, const fs::path& finding) {
  std::ofstream(folder / "scene.off") << screen_scene;
  std::string other = screen_scene;
  std::ofstream(folder / "other.off") << other.replace(other.find("9 0 2"), 5, "8 0 2");
  std::ofstream(folder / "all.pvs") << "0\n1\n2\n3\n4\n";
  const auto sh = [&](const std::string& text, const char* output) {
    return run_script(folder, finding, text, folder / output);
  };
  if (!attack.make.empty() && sh(attack.make, "made") != 0) return "cannot be prepared: " + read_all(folder / "made");
  const int code = sh(attack.run, "output");
  const std::string output = read_all(folder / "output");
  if (code != attack.exit_code)
    return "exit code " + std::to_string(code) + " and not " + std::to_string(attack.exit_code) + ": " + output;
  if (output.find(attack.says) == output.npos) return "does not say '" + attack.says + "': " + output;
  if (!attack.check.empty() && sh(attack.check, "checked") != 0)
    return "afterwards it is not true that: " + attack.check + ": " + read_all(folder / "checked");
  return {};
}

}  // namespace clues::tests
