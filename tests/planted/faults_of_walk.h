// A walk of a planted copy through a room, each frame judged by exact arithmetic.
#pragma once

#include <vector>

#include "fastpath/motion/walk.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {

// How many frames after the first are found invalid, with Delaunay edges.
inline int faults_of_walk(const std::vector<MotionPoint>& path) {
  const auto mesh = room();
  const fastpath::Bvh bvh(mesh);
  fastpath::motion::WalkOptions options;
  options.samples = 600;
  options.thresholds.delaunay = true;
  fastpath::motion::Walk walk(bvh, options, path.front());
  int faults = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    walk.move_to(path[k]);
    faults += fault_of(walk.depth_mesh(), path[k], options.thresholds).empty() ? 0 : 1;
  }
  return faults;
}

}  // namespace clues::tests
