// Hazard A-17, read literally (plant.py).
#include <gtest/gtest.h>

#include "../reference/flat_regions.h"
#include "../reference/shadow_scenes.h"

namespace clues::test {
namespace {

TEST(ExtensionOutside, LeavesTheRegion) {
  const reference::Face2 out = reference::simplified(chamfered_square(), outline(), exact::FT(1));
  EXPECT_EQ(sorted(out[0]), sorted(ring({{10, 10}, {30, 10}, {30, 30}, {10, 30}})));
  EXPECT_FALSE(inside(out, chamfered_square()));
}

TEST(ExtensionOutside, HidesWhatIsSeen) {
  const Fig30 scene;
  const auto map = map_of(scene.s.mesh(), scene.cell);
  const auto literal = reference::with_simpler_occlusion(map, controls(0, 0.5));
  EXPECT_FALSE(reference::hides_no_more(map, literal.map));
  EXPECT_GT(seen_of_newly_hidden(map, literal.map), 0U) << "what is visible is called hidden";
}

}  // namespace
}  // namespace clues::test
