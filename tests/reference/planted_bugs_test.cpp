// Tests of the tests: each planted bug must be caught by a judge within a few scenes, or the judges are decoration.
#include <gtest/gtest.h>

#include "fuzz/generators/random_scenes.h"
#include "judges.h"

namespace clues::test {
namespace {

using reference::PlantedBug;

constexpr std::uint64_t kSeed = 7;

// The number of contradictions, two walks included, over scenes of all kinds; stops at the first scene that has one.
std::uint64_t caught(PlantedBug bug, std::uint64_t scenes) {
  reference::Options options;
  options.planted_bug = bug;
  for (std::uint64_t i = 0; i < scenes; ++i) {
    for (const fuzz::Kind kind : fuzz::all_kinds) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      const auto map = map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell), options);
      const std::uint64_t n = contradictions(map, 6, kSeed).total() + map.statistics.walk_disagreements;
      if (n > 0) {
        std::cout << "caught in " << scene.name << ": " << n << "\n";
        return n;
      }
    }
  }
  return 0;
}

TEST(PlantedBug, NoneIsCaughtWhereNoneIs) { EXPECT_EQ(caught(PlantedBug::none, 2), 0U); }
TEST(PlantedBug, WrongWedgeSideIsCaught) { EXPECT_GT(caught(PlantedBug::wrong_wedge_side, 8), 0U); }
TEST(PlantedBug, RetestedCsvIsCaught) { EXPECT_GT(caught(PlantedBug::retested_csv, 8), 0U); }
TEST(PlantedBug, MissingRule3IsCaught) { EXPECT_GT(caught(PlantedBug::no_rule_3, 8), 0U); }
TEST(PlantedBug, RoundedComparisonIsCaught) { EXPECT_GT(caught(PlantedBug::rounded_comparison, 8), 0U); }

}  // namespace
}  // namespace clues::test
