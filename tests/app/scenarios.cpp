#include "tests/app/scenarios.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "scene/files/atomic_file.h"
#include "tests/app/finding_fixture.h"
#include "tests/app/program.h"
#include "tests/app/script.h"

namespace clues::tests {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int sh(const fs::path& folder, const fs::path& place, const std::string& text) {
  return run_script(folder, place / "finding", text, place / "sh-output");
}

// What waits to be moved into place counts as long as a commit stands beside it; and a commit, as long as something waits.
bool counts_for_nothing(const fs::path& path) {
  const std::string name = path.filename().string();
  if (path.parent_path().filename() == ".clues-pending") {
    const auto waiting = std::distance(fs::directory_iterator(path.parent_path()), fs::directory_iterator());
    return !fs::exists(path.parent_path() / "commit") || waiting == 1;
  }
  return scene::is_temporary_name(name) || name == ".clues-lock" || name.ends_with("-journal") ||
         name.find(".bake.finishing") != std::string::npos;
}

}  // namespace

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all{
      {"map", "echo old > out.clues.json", "map scene.off --cell $CELL -o out.clues.json", ":"},
      {"map_with_umbra", "echo old > out.clues.json", "map scene.off --cell $CELL -o out.clues.json --umbra umbra.json",
       "rm -f umbra.json"},
      {"map_cells", ":", "map scene.off --cells $GRID -o d", "clues map scene.off --cells $GRID -o d --resume", true},
      {"map_resume", "cells scene.off d && rm d/cell-1-0-0.clues.json", "map scene.off --cells $GRID -o d --resume",
       "clues map scene.off --cells $GRID -o d --resume", true},
      {"bake", ":", "bake scene.off --cells $GRID -o b.bake --group 2",
       "clues bake scene.off --cells $GRID -o b.bake --group 2", true},
      {"precision", "echo old > p.json", "precision scene.off --cell $CELL --max-depth 0 -o p.json", ":"},
      {"conform", "answers a && rm -r cases && echo old > c.json",
       "conform --results a --suite $SUITE --case $CASE --json c.json", ":", false,
       "\"$PYTHON\" -c 'import json; json.load(open(\"c.json\"))[\"cases\"][0][\"outcome\"]'"},
      {"conform_export", ":", "conform --export cases --suite $SUITE --case $CASE",
       "clues conform --export cases --suite $SUITE --case $CASE", true},
      {"fuzz", ":", "fuzz --subject false --cases 2 --generator loose_triangles --out c",
       "clues fuzz --subject false --cases 2 --generator loose_triangles --out c; "
       "[ $? = 1 ] && store c/findings.sqlite 'open(\"c/dump\", \"w\").write(\"\\n\".join(s.iterdump()))' && "
       "rm c/findings.sqlite",
       true},
      {"shrink", "finding f && echo mine > f/notes.txt", "shrink f/ --subject \"$BLIND\" --max-steps 8",
       "replays f && [ ! -e f/.clues-pending/commit ]", false,
       "replays f && [ \"$(cat f/notes.txt)\" = mine ] && [ ! -e f/.clues-pending/commit ]"},
      {"replay", "finding f", "replay f --subject \"$BLIND\"", ":"},
      {"promote", "finding f && suite s && echo mine > s/notes.txt",
       "replay f --subject \"$BLIND\" --promote s --id new-one", "clues lint s"},
      {"lint", "suite s && sed -i 's/^  //' s/needles.json", "lint s --write", ":"},
      {"demo", "demo_meshes m && mkdir d && echo old > d/city.pvs", "demo --quick --mesh-dir m --out d",
       "clues demo --quick --mesh-dir m --out d", true},
      {"report", "mkdir r && judgement r/a.json && finding r/f", "report r", ":"},
  };
  return all;
}

Tree tree_of(const fs::path& folder) {
  Tree tree;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (counts_for_nothing(entry.path())) continue;
    if (entry.is_symlink()) {
      tree[name] = "-> " + fs::read_symlink(entry.path()).string();
    } else if (entry.is_regular_file()) {
      tree[name] = read_all(entry.path());
    }
  }
  return tree;
}

std::string difference(const Tree& a, const Tree& b) {
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end()) return name + " is there and should not";
    if (other->second != bytes) return name + " is another";
  }
  for (const auto& [name, bytes] : b) {
    if (!a.contains(name)) return name + " is missing";
  }
  return {};
}

Stage::Stage(const Scenario& scenario) : scenario_(scenario) {
  std::string pattern = (fs::temp_directory_path() / "clues-stage-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  place_ = pattern;
  make_finding(place_ / "finding");
  const fs::path old = place_ / "old";
  fs::create_directory(old);
  std::ofstream(old / "scene.off") << screen_scene;
  std::ofstream(old / "all.pvs") << "0\n1\n2\n3\n4\n";
  if (sh(old, place_, scenario_.make) != 0)
    throw std::runtime_error(std::string(scenario_.name) + " cannot be made: " + read_all(place_ / "sh-output"));
  old_ = tree_of(old);
  const fs::path folder = fresh();
  const auto begin = Clock::now();
  const Run whole = run(folder, "", 0);
  seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
  exit_code_ = whole.code;
  if (whole.code < 0 || whole.code > 1) throw std::runtime_error(std::string(scenario_.name) + " fails: " + whole.err);
  std::istringstream counts(read_all(place_ / "counts"));
  long n = 0;
  for (std::string call; counts >> call >> n;) calls_[call] = n;
  new_ = tree_of(folder);
  settle(folder);
  new_settled_ = tree_of(folder);
  const fs::path before = fresh();
  settle(before);
  old_settled_ = tree_of(before);
  fs::remove_all(before);
  fs::remove_all(folder);
}

Stage::~Stage() {
  std::error_code ignored;
  fs::remove_all(place_, ignored);
}

fs::path Stage::fresh() const {
  // Always the same path: it is in what some commands write.
  const fs::path folder = place_ / "state";
  fs::remove_all(folder);
  fs::copy(place_ / "old", folder, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  return folder;
}

Stage::Run Stage::run(const fs::path& folder, const std::string& fault, double kill_after) const {
  const fs::path out = place_ / "out", err = place_ / "err";
  std::string words = std::string("set -- ") + scenario_.run + "; ";
  if (kill_after <= 0) {
    words +=
        "export CLUES_FAULT_COUNTS=" + quoted((place_ / "counts").string()) + " LD_PRELOAD=" + quoted(FAULTS) + "; ";
    if (!fault.empty()) words += "export CLUES_FAULT=" + quoted(fault) + "; ";
  }
  words += "exec \"$CLUES\" \"$@\"";
  const std::string command = script_command(folder, place_ / "finding", words) + " >" + quoted(out.string()) + " 2>" +
                              quoted(err.string()) + " </dev/null";
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    setpgid(0, 0);
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  if (kill_after > 0) {
    pollfd ended{static_cast<int>(syscall(SYS_pidfd_open, child, 0)), POLLIN, 0};
    poll(&ended, 1, static_cast<int>(std::lround(1000 * kill_after)));
    close(ended.fd);
    kill(-child, SIGKILL);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL,
          read_all(out), read_all(err)};
}

int Stage::settle(const fs::path& folder) const { return sh(folder, place_, scenario_.settle); }

std::string Stage::flaw_of(const fs::path& folder, bool done) const {
  // No file of the old or new state is there in part, whatever else is: not even before the next command.
  for (const auto& [name, bytes] : tree_of(folder)) {
    const auto before = old_.find(name), after = new_.find(name);
    const bool known = before != old_.end() || after != new_.end();
    const bool is_old = before != old_.end() && before->second == bytes,
               is_new = after != new_.end() && after->second == bytes;
    if (known && !is_old && !is_new && !name.ends_with(".sqlite") && !name.ends_with(".bake")) {
      const bool third = scenario_.also_right != nullptr && sh(folder, place_, scenario_.also_right) == 0;
      return third ? "" : name + " is neither old nor new";
    }
  }
  settle(folder);
  const Tree now = tree_of(folder);
  const std::string from_new = difference(now, new_settled_);
  if (from_new.empty()) return {};
  if (done) return "it said that it was done, but " + from_new;
  if (scenario_.goes_on) return "after the next command " + from_new;
  const std::string from_old = difference(now, old_settled_);
  return from_old.empty() ? "" : "neither the old state (" + from_old + ") nor the new one (" + from_new + ")";
}

// Whether a line of a message names a path of these states, or begins with one that has a folder in it, or with the
// process of ours that was lost.
bool Stage::names_a_path(const std::string& line) const {
  const std::string begin = "clues: error: ";
  const std::size_t from = line.starts_with(begin) ? begin.size() : 0;
  const std::string path = line.substr(from, line.find(": ", from) - from);
  if (path.find('/') != std::string::npos || path == "a child process") return true;
  const auto below = [&](const auto& file) {
    return file.first == path || file.first.starts_with(path + "/") || line.find(file.first + ": ") != line.npos;
  };
  return std::any_of(old_.begin(), old_.end(), below) || std::any_of(new_.begin(), new_.end(), below);
}

std::string Stage::after_fault(const std::string& fault) const {
  const fs::path folder = fresh();
  const Run ran = run(folder, fault, 0);
  const std::string said = "exit code " + std::to_string(ran.code) + ": " + ran.err + ran.out + ": ";
  if (fault.ends_with("KILL")) return flaw_of(folder, !ran.killed && ran.code == exit_code_);
  // libcrypto 3.0 reads a lock that is not there when its own first allocations fail; nothing may be lost by that either.
  if (ran.code < 0) return fault.starts_with("malloc:") ? flaw_of(folder, false) : "it crashed: " + ran.err;
  if (ran.code == 4) return said + "a fault of the system is no defect of clues";
  const bool done = ran.code == exit_code_;
  if (!done) {
    // Errors are on standard error; what is wrong with one file of many is in the report.
    std::istringstream lines(ran.err + ran.out);
    bool names_a_file = ran.err.find(": the subject gives no answer: ") != std::string::npos;
    for (std::string line; std::getline(lines, line);) names_a_file |= names_a_path(line);
    if (ran.err.find("clues: error: ") == std::string::npos && !names_a_file)
      return said + "it does not say what is wrong";
    if (!names_a_file && ran.err.find("out of memory") == std::string::npos) return said + "it names no file";
  }
  const std::string flaw = flaw_of(folder, done);
  return flaw.empty() ? "" : said + flaw;
}

std::string Stage::after_kill(double seconds) const {
  const fs::path folder = fresh();
  const Run ran = run(folder, "", seconds);
  return flaw_of(folder, !ran.killed && ran.code == exit_code_);
}

}  // namespace clues::tests
