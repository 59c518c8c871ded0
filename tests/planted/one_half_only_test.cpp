// Linked with a refinement that maps one half of each part of the cell only (plant.py). The ordinary tests (tests/fastpath/refinement_test.cpp) ask the same of both
// halves.
#include <gtest/gtest.h>

#include "../fastpath/refinement_judges.h"

namespace clues::fastpath {
namespace {

TEST(OneHalfOnly, IsCaughtByTheJudges) {
  const Scene s = slits_and_tiles();
  RefinementOptions options;
  options.max_depth = 2;
  options.sight_lines = 0;
  for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection}) {
    options.by = by;
    options.regions = false;
    EXPECT_GT(lost(s, refine(s.mesh, s.cell, options)), 0U);
    options.regions = true;
    Judged judged;
    judge_points(s.mesh, s.cell, refine(s.mesh, s.cell, options), 2000, judged);
    EXPECT_GT(judged.seen_points, 0U);
  }
}

TEST(OneHalfOnly, HidesWhatIsSeenInTheSceneOfHazardA4) {
  const HazardA4 s;
  RefinementOptions options;
  options.by = RefineBy::backprojection;
  options.max_depth = 1;
  options.sight_lines = 0;
  const Ids raw = refine(s.mesh, s.cell, options).visible;
  EXPECT_FALSE(lists(raw, s.target) || lists(raw, s.target + 1)) << "the raw adjusted wedge hides what is seen";
}

}  // namespace
}  // namespace clues::fastpath
