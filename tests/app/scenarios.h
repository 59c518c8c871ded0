// Commands that write, as scenarios for what may happen to them in the middle: a call that fails, a kill. Whatever happens, what is left must be the old state or the new one.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace clues::tests {

struct Scenario {
  const char* name;
  const char* make;  // the old state (sh, after attacks/prelude.sh), in the folder `state`, from which all is run
  const char* run;   // arguments of clues, as in sh
  const char*
      settle;  // what the user does next (sh); it may finish what was begun, and may not change a state that is whole
  // The new state is reached again by settling after anything (a run that goes on), so the old one need not stay.
  bool goes_on = false;
  // A third state that is right as well, where the command looks for a good answer and a fault on its way makes it find
  // another: what must then hold (sh).
  const char* also_right = nullptr;
};

const std::vector<Scenario>& scenarios();

// Every file below the folder by its path, with its bytes; links by where they point. Without temporary files and lock files, which count for nothing.
using Tree = std::map<std::string, std::string>;
Tree tree_of(const std::filesystem::path& folder);
std::string difference(const Tree& a, const Tree& b);  // the first; empty: none

// A scenario with its old and its new state made.
class Stage {
 public:
  explicit Stage(const Scenario& scenario);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Calls of each kind that a run makes which nothing disturbs.
  const std::map<std::string, long>& calls() const { return calls_; }
  double seconds() const { return seconds_; }  // that it takes

  // Runs it with a fault ("write:3:EIO"), or kills it (and its group) after so many seconds. Empty, or what is wrong with what it left or said.
  std::string after_fault(const std::string& fault) const;
  std::string after_kill(double seconds) const;

 private:
  struct Run {
    int code = -1;
    bool killed = false;
    std::string out, err;
  };
  std::filesystem::path fresh() const;  // a copy of the old state
  Run run(const std::filesystem::path& folder, const std::string& fault, double kill_after) const;
  int settle(const std::filesystem::path& folder) const;
  std::string flaw_of(const std::filesystem::path& folder, bool done) const;
  bool names_a_path(const std::string& line) const;

  const Scenario& scenario_;
  std::filesystem::path place_;
  int exit_code_ = 0;
  std::map<std::string, long> calls_;
  double seconds_ = 0;
  Tree old_, new_, old_settled_, new_settled_;
};

}  // namespace clues::tests
