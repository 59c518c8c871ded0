// The exact visible set with a wrong decision (plant.py). The ordinary tests (tests/validate/visible_set_test.cpp) say that the triangle is seen.
#include <gtest/gtest.h>

#include "../validate/sight_scenes.h"

namespace clues::validate {
namespace {

TEST(ForgetTriples, HidesWhatIsSeenThroughAHoleBetweenThreeShadows) {
  const tests::HoleBetweenShadows scene;
  EXPECT_EQ(tests::sight_of(scene.scene.mesh, scene.target, scene.cell), Sight::hidden);
}

}  // namespace
}  // namespace clues::validate
