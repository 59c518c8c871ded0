// The table of attacks on files that clues keeps: findings, campaigns, folders of cells, results, reports (docs/threats.md). CLUES_ATTACKED names another program to be attacked,
// CLUES_ATTACKED_FINDING a finding that this one can read: so the last column of the table was made.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "fuzz/campaign/finding_folder.h"
#include "tests/app/attacks.h"
#include "tests/app/program.h"

namespace clues::tests {
namespace {

const std::vector<Attack>& attacks() {
  static const auto all = read_attacks(std::string(CLUES_TEST_DATA) + "/attacks/stores.txt");
  return all;
}

// Triangle 4 of the screen is hidden, says a program that hides everything.
void make_finding(const std::filesystem::path& folder) {
  fuzz::SavedFinding saved;
  fuzz::Finding& f = saved.finding;
  f.oracle = "sight-lines";
  f.verdict = "hidden/visible";
  f.explanation = "a free sight line ends on a triangle that is called hidden";
  f.where.generator = "loose_triangles";
  f.where.seed = 1;
  f.where.mesh.points = {{-20, -20, 4}, {20, -20, 4}, {20, 20, 4},        {-20, 20, 4},      {-6, -4, 2},
                         {6, -4, 2},    {0, 8, 2},    {-0.5, -0.5, 2.25}, {0.5, -0.5, 2.25}, {0, 0.5, 2.25},
                         {9, 0, 2},     {10, 0, 2},   {9, 1, 2}};
  f.where.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}, {7, 9, 8}, {10, 12, 11}};
  f.where.mesh.face_of = {0, 1, 2, 3, 4};
  for (const double z : {-0.25, 0.0}) {
    for (const double y : {-0.25, 0.25}) {
      for (const double x : {-0.25, 0.25}) f.where.cell.push_back({x, y, z});
    }
  }
  f.triangle = 4;
  f.witness = fuzz::WitnessText{4, true, {"0", "0", "-1/8"}, {"2364/251", "84/251", "2"}};
  saved.subject = "reference";
  saved.original = f;
  fuzz::save_finding(saved, folder);
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
