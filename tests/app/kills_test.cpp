// kill -9 in the middle of commands that write: nothing is lost, nothing mixed. In the gate at chosen calls, which is the same in every run; in the long test at 500 moments at random (the clock decides what
// they hit; the seed, which moments).
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "tests/app/scenarios.h"

namespace clues::tests {
namespace {

constexpr unsigned seed = 20261122;
const std::vector<std::string> killed{"map", "map_cells", "bake", "fuzz", "shrink", "replay", "promote", "conform"};

const Scenario& named(const std::string& name) {
  return *std::find_if(scenarios().begin(), scenarios().end(), [&](const Scenario& s) { return name == s.name; });
}

class Kills : public testing::TestWithParam<std::string> {};
class KillsLong : public Kills {};

TEST_P(Kills, AtACallLoseNothing) {
  const Stage stage(named(GetParam()));
  std::vector<std::string> moments;
  for (const auto& [call, count] : stage.calls()) {
    if (call != "rename" && call != "write" && call != "unlink" && call != "mkdir") continue;
    for (long n = 1; n <= count; ++n) moments.push_back(call + ":" + std::to_string(n) + ":KILL");
  }
  std::shuffle(moments.begin(), moments.end(), std::mt19937(seed));
  moments.resize(std::min<std::size_t>(moments.size(), 4));
  for (const std::string& moment : moments) EXPECT_EQ(stage.after_fault(moment), "") << moment;
  std::cout << GetParam() << ": " << moments.size() << " kills\n";
}

TEST_P(KillsLong, AtAnyMomentLoseNothing) {
  const Stage stage(named(GetParam()));
  std::mt19937 random(seed);
  constexpr int moments = 72;  // of each of the eight: 576
  for (int i = 0; i < moments; ++i) {
    const double when = std::uniform_real_distribution<double>(0.002, 1.05 * stage.seconds())(random);
    EXPECT_EQ(stage.after_kill(when), "") << "after " << when << " s";
  }
  std::cout << GetParam() << ": " << moments << " kills\n";
}

// Every call that changes something, and every one before it.
TEST_P(KillsLong, AtEveryCallLoseNothing) {
  const Stage stage(named(GetParam()));
  int kills = 0;
  for (const auto& [call, count] : stage.calls()) {
    if (call == "malloc" || call == "mmap" || call == "read") continue;
    for (long n = 1; n <= count; ++n, ++kills)
      EXPECT_EQ(stage.after_fault(call + ":" + std::to_string(n) + ":KILL"), "") << call << " " << n;
  }
  std::cout << GetParam() << ": " << kills << " kills\n";
}

std::string name_of(const testing::TestParamInfo<std::string>& one) { return one.param; }

INSTANTIATE_TEST_SUITE_P(Commands, Kills, testing::ValuesIn(killed), name_of);
INSTANTIATE_TEST_SUITE_P(Commands, KillsLong, testing::ValuesIn(killed), name_of);

}  // namespace
}  // namespace clues::tests
