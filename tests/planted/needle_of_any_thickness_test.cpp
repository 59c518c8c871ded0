// A needle whose odometer stands still when the viewpoint goes aside: on a way with corners edges fail that a walk never looks at, and exact arithmetic notices.
#include <gtest/gtest.h>

#include "tests/planted/faults_of_walk.h"

namespace clues::tests {
namespace {

TEST(NeedleOfAnyThickness, FramesAreFoundInvalid) {
  std::vector<MotionPoint> path{{0, 0, 0}};
  for (int k = 0; k < 60; ++k) {
    path.push_back(path.back());
    path.back()[static_cast<std::size_t>(k / 15) % 2] += k < 30 ? 0.02 : -0.02;
  }
  EXPECT_GT(faults_of_walk(path), 0);
}

}  // namespace
}  // namespace clues::tests
