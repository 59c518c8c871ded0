// A calendar that leaves out a bin: triangles fail that a walk never looks at, and exact arithmetic notices.
#include <gtest/gtest.h>

#include "scene/motion/view_path.h"
#include "tests/planted/faults_of_walk.h"

namespace clues::tests {
namespace {

TEST(SkippedBin, FramesAreFoundInvalid) {
  EXPECT_GT(faults_of_walk(scene::read_view_path("orbit:0,0,0,0.5,0.25", 60)), 0);
}

}  // namespace
}  // namespace clues::tests
