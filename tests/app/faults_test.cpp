// Every call that can fail, failed once, in every command that writes (tests/faults/faults.c). Afterwards there is the old state or the new one, a message that names the file, and no crash.
// Some calls in the gate, all of them in the long test; allocations, of which there are thousands, at some places.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "tests/app/scenarios.h"

namespace clues::tests {
namespace {

constexpr unsigned seed = 20261122;

std::vector<std::string> hows_of(const std::string& call) {
  if (call == "read") return {"EIO", "SHORT", "EINTR"};
  if (call == "write") return {"ENOSPC", "EIO", "SHORT", "EINTR"};
  if (call == "malloc" || call == "mmap") return {"ENOMEM"};
  if (call == "open" || call == "mkdir") return {"EACCES", "ENOSPC"};
  if (call == "rename" || call == "unlink" || call == "rmdir") return {"EACCES", "EIO"};
  return {"EIO"};
}

// All faults of a run, allocations at `allocations` places of it.
std::vector<std::string> faults_of(const Stage& stage, long allocations) {
  std::vector<std::string> all;
  for (const auto& [call, count] : stage.calls()) {
    const long places = call == "malloc" ? std::min(count, allocations) : count;
    for (long i = 0; i < places; ++i) {
      const long n = call == "malloc" ? 1 + i * count / places : 1 + i;
      for (const std::string& how : hows_of(call)) all.push_back(call + ":" + std::to_string(n) + ":" + how);
    }
  }
  return all;
}

void run_all(const Stage& stage, const std::vector<std::string>& faults, const char* name) {
  for (const std::string& fault : faults) EXPECT_EQ(stage.after_fault(fault), "") << name << ", " << fault;
  std::cout << name << ": " << faults.size() << " faults\n";
}

class Faults : public testing::TestWithParam<std::size_t> {
 protected:
  const Scenario& scenario() const { return scenarios()[GetParam()]; }
};
class FaultsLong : public Faults {};

TEST_P(Faults, LeaveTheOldStateOrTheNewOne) {
  const Stage stage(scenario());
  std::vector<std::string> faults = faults_of(stage, 8);
  std::shuffle(faults.begin(), faults.end(), std::mt19937(seed));
  faults.resize(std::min<std::size_t>(faults.size(), 12));
  run_all(stage, faults, scenario().name);
}

TEST_P(FaultsLong, LeaveTheOldStateOrTheNewOne) {
  const Stage stage(scenario());
  run_all(stage, faults_of(stage, 60), scenario().name);
}

std::string name_of(const testing::TestParamInfo<std::size_t>& one) { return scenarios()[one.param].name; }

INSTANTIATE_TEST_SUITE_P(Commands, Faults, testing::Range<std::size_t>(0, scenarios().size()), name_of);
INSTANTIATE_TEST_SUITE_P(Commands, FaultsLong, testing::Range<std::size_t>(0, scenarios().size()), name_of);

}  // namespace
}  // namespace clues::tests
