// Hazard A-16, read literally (plant.py).
#include <gtest/gtest.h>

#include "../reference/flat_regions.h"
#include "../reference/shadow_scenes.h"
#include "wrong_step.h"

namespace clues::test {
namespace {

TEST(ChordOutside, LeavesTheRegion) {
  std::size_t outside = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    outside += !inside(reference::simplified(star(seed), outline(), exact::FT(400)), star(seed));
  EXPECT_GT(outside, 6U);
}

TEST(ChordOutside, HidesWhatIsSeen) {
  const Window scene;
  expect_hides_what_is_seen(map_of(scene.s.mesh(), scene.cell));
}

}  // namespace
}  // namespace clues::test
