// fork, exec, wait: outputs go to files, so that nothing can block.
#include "tests/app/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace clues::tests {

namespace fs = std::filesystem;

// Triangles 0, 1: wall. 2: screen, wide. 3: small, right behind the screen. 4: off to the side.
const char* const screen_scene =
    "OFF\n13 5 0\n"
    "-20 -20 4\n20 -20 4\n20 20 4\n-20 20 4\n"
    "-6 -4 2\n6 -4 2\n0 8 2\n"
    "-0.5 -0.5 2.25\n0.5 -0.5 2.25\n0 0.5 2.25\n"
    "9 0 2\n10 0 2\n9 1 2\n"
    "3 0 2 1\n3 0 3 2\n3 4 6 5\n3 7 9 8\n3 10 12 11\n";

std::string TestFolder::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(file(name), std::ios::binary) << bytes;
  return file(name);
}

std::vector<std::string> TestFolder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(path())) found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string attacked_program() {
  const char* other = std::getenv("CLUES_ATTACKED");
  return other != nullptr ? other : CLUES_PROGRAM;
}

namespace {

// `input`: what standard input is read from; empty: as it is.
Ran run(const std::string& input, const std::vector<std::string>& arguments, const fs::path& folder) {
  const TestFolder outputs;
  const auto out = outputs.file("out"), err = outputs.file("err");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    if (chdir(folder.c_str()) != 0) _exit(126);
    if (!input.empty()) dup2(open(input.c_str(), O_RDONLY), STDIN_FILENO);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), CLUES_PROGRAM);
    std::vector<char*> raw;
    for (auto& word : words) raw.push_back(word.data());
    raw.push_back(nullptr);
    execv(CLUES_PROGRAM, raw.data());
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
}

}  // namespace

Ran run_clues(const std::vector<std::string>& arguments, const fs::path& folder) { return run({}, arguments, folder); }

Ran run_clues_on(const std::string& input, const std::vector<std::string>& arguments, const fs::path& folder) {
  const TestFolder inputs;
  return run(inputs.write("in", input), arguments, folder);
}

Ran run_clues(std::vector<std::string> arguments, const std::vector<std::string>& more, const fs::path& folder) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_clues(arguments, folder);
}

}  // namespace clues::tests
