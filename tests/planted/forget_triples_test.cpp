// The exact visible set with a wrong decision (plant.py). The ordinary tests (tests/validate/visible_set_test.cpp) say that the triangle is seen.
#include <gtest/gtest.h>

#include "../validate/sight_scenes.h"
#include "validate/visible_set/visible_set.h"

namespace clues::validate {
namespace {

TEST(ForgetTriples, HidesWhatIsSeenThroughAHoleBetweenThreeShadows) {
  const tests::HoleBetweenShadows scene;
  VisibleSetOptions options;
  options.trust_map = false;
  EXPECT_EQ(exact_visible_set(scene.scene.mesh, scene.cell, options).triangles[scene.target].sight, Sight::hidden);
}

}  // namespace
}  // namespace clues::validate
