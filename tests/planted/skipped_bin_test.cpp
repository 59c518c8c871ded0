// A calendar that leaves out a bin: triangles fail that a walk never looks at, and exact arithmetic notices.
#include <gtest/gtest.h>

#include "fastpath/motion/walk.h"
#include "scene/motion/view_path.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

TEST(SkippedBin, FramesAreFoundInvalid) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  fastpath::motion::WalkOptions options;
  options.samples = 600;
  options.thresholds.delaunay = true;
  const auto path = scene::read_view_path("orbit:0,0,0,0.5,0.25", 60);
  fastpath::motion::Walk walk(bvh, options, path.front());
  int faults = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    walk.move_to(path[k]);
    faults += fault_of(walk.depth_mesh(), path[k], options.thresholds).empty() ? 0 : 1;
  }
  EXPECT_GT(faults, 0);
}

}  // namespace
}  // namespace clues::tests
