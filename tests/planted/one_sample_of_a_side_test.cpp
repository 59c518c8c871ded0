// Linked with a fast path that asks whether what the limits of D17 left out can reach one place beside a side, and takes the answer for all of the side (plant.py):
// the defect that it once had. The ordinary test (CellsOfEveryDimension.LimitsHideNothing) puts the same scenes to the same judge.
#include <gtest/gtest.h>

#include "../differential/touching_series.h"

namespace clues::tests {
namespace {

TEST(OneSampleOfASide, IsCaughtByTheScenesOfLimits) {
  const Totals totals = judge_series(limited_series(), 0, 28);
  EXPECT_TRUE(totals.flaws.contains("WRONG: a visible triangle is missing from the fast path"));
}

}  // namespace
}  // namespace clues::tests
