// Hazard A-17, read literally (plant.py).
#include <gtest/gtest.h>

#include "../reference/flat_regions.h"
#include "../reference/shadow_scenes.h"
#include "wrong_step.h"

namespace clues::test {
namespace {

TEST(ExtensionOutside, LeavesTheRegion) {
  const reference::Face2 out = reference::simplified(chamfered_square(), outline(), exact::FT(1));
  EXPECT_EQ(sorted(out[0]), sorted(ring({{10, 10}, {30, 10}, {30, 30}, {10, 30}})));
  EXPECT_FALSE(inside(out, chamfered_square()));
}

TEST(ExtensionOutside, HidesWhatIsSeen) {
  const Fig30 scene;
  expect_hides_what_is_seen(map_of(scene.s.mesh(), scene.cell));
}

}  // namespace
}  // namespace clues::test
