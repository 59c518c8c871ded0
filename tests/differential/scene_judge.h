// One small scene, asked of every kernel, and every answer judged by what shares no algorithm with them: sight lines in
// plain rationals (D5, D6), point occlusion (D18), the exact visible set, and each other (D9, D15). Nothing is thrown
// and nothing stops at the first flaw.
#pragma once

#include <cstddef>

#include "tests/differential/scene_kernels.h"

namespace clues::tests {

struct JudgeSettings : KernelSettings {
  bool visible_set = false;  // decide the scene completely
  std::size_t points_per_region = 3;
  int sight_lines = 6;  // to each triangle that somebody does not list
  bool truth = true;    // else only the kernels, against each other
};

Judgement judge_scene(const fuzz::Case& scene, const JudgeSettings& settings);

}  // namespace clues::tests
