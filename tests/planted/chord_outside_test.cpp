// Hazard A-16, read literally (plant.py).
#include <gtest/gtest.h>

#include "../reference/flat_regions.h"
#include "../reference/shadow_scenes.h"

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
  const auto map = map_of(scene.s.mesh(), scene.cell);
  const auto literal = reference::with_simpler_occlusion(map, controls(0, 0.5));
  EXPECT_FALSE(reference::hides_no_more(map, literal.map));
  EXPECT_GT(seen_of_newly_hidden(map, literal.map), 0U) << "what is visible is called hidden";
}

}  // namespace
}  // namespace clues::test
