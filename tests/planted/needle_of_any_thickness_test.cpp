// A needle whose odometer stands still when the viewpoint goes aside: on a way with corners edges fail that a walk never looks at, and exact arithmetic notices.
#include <gtest/gtest.h>

#include "fastpath/motion/walk.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

TEST(NeedleOfAnyThickness, FramesAreFoundInvalid) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  fastpath::motion::WalkOptions options;
  options.samples = 600;
  options.thresholds.delaunay = true;
  MotionPoint at{};
  fastpath::motion::Walk walk(bvh, options, at);
  int faults = 0;
  for (int k = 0; k < 60; ++k) {
    at[static_cast<std::size_t>(k / 15) % 2] += k < 30 ? 0.02 : -0.02;
    walk.move_to(at);
    faults += fault_of(walk.depth_mesh(), at, options.thresholds).empty() ? 0 : 1;
  }
  EXPECT_GT(faults, 0);
}

}  // namespace
}  // namespace clues::tests
