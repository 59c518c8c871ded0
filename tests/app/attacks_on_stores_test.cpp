// The table of attacks on files that clues keeps: findings, campaigns, folders of cells, results, reports (docs/threats.md). CLUES_ATTACKED names another program to be attacked,
// CLUES_ATTACKED_FINDING a finding that this one can read: so the last column of the table was made.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "tests/app/attacks.h"
#include "tests/app/finding_fixture.h"
#include "tests/app/program.h"

namespace clues::tests {
namespace {

const std::vector<Attack>& attacks() {
  static const auto all = read_attacks(std::string(CLUES_TEST_DATA "/attacks/stores.txt"));
  return all;
}

class AttackOnStores : public testing::TestWithParam<std::size_t> {};

TEST_P(AttackOnStores, Fails) {
  const Attack& attack = attacks()[GetParam()];
  const TestFolder finding, folder;
  const char* given = std::getenv("CLUES_ATTACKED_FINDING");
  if (given == nullptr) make_finding(finding.path() / "finding");
  EXPECT_EQ(outcome_of(attack, folder.path(), given != nullptr ? given : finding.file("finding")), "") << attack.name;
}

std::vector<std::size_t> numbers() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < attacks().size(); ++i) all.push_back(i);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Stores, AttackOnStores, testing::ValuesIn(numbers()), [](const auto& one) {
  std::string name = attacks()[one.param].name;
  for (char& c : name) {
    if (c == '-') c = '_';
  }
  return name;
});

TEST(AttacksOnStores, AreManyAndEachIsOne) {
  std::size_t failed = 0;
  for (const Attack& attack : attacks()) {
    EXPECT_FALSE(attack.run.empty()) << attack.name;
    EXPECT_GE(attack.exit_code, 0) << attack.name;
    failed += !attack.held_before;
  }
  EXPECT_GE(attacks().size(), 60U);
  std::cout << attacks().size() << " attacks, " << failed << " of which failed before the table was made\n";
}

}  // namespace
}  // namespace clues::tests
