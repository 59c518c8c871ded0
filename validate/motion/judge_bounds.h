// The judge of anyone's motion bounds, one a triangle: for every claim a proof, or a viewpoint inside of the claimed ball that violates a
// constraint of the triangle, or neither, with the radius up to which it is proved.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "exact/motion/sight_row.h"
#include "scene/motion/constraint.h"
#include "scene/motion/motion_files.h"

namespace clues::validate {

enum class BoundVerdict : std::uint8_t { proved, refuted, undecided };

struct BoundJudgement {
  BoundVerdict verdict = BoundVerdict::undecided;
  double claim = 0;
  double proved = 0;                // nothing nearer than that violates: the claim, or less
  scene::ConstraintPlace place;     // refuted: what is violated; undecided: what was not decided
  exact::ExactViewpoint viewpoint;  // refuted: where
};

struct JudgeBoundsOptions {
  int threads = 0;                    // 0: as many as the machine has; the answer is the same
  std::uint64_t most_cubes = 20'000;  // for one constraint
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // called from one thread at a time
};

struct BoundsReport {
  std::vector<BoundJudgement> triangles;
  std::uint64_t proved = 0, refuted = 0, undecided = 0;
};

// The claim of triangle i is that no v with |v - viewpoint| < claims[i] violates any of its constraints. A claim of 0 says nothing, and is
// proved. claims: as many as triangles, each 0, more or infinite, or Error bad_argument; with thresholds.delaunay also a mesh that
// require_one_across refuses.
BoundsReport judge_motion_bounds(const scene::DepthMesh& mesh, const scene::MotionThresholds& thresholds,
                                 const scene::MotionPoint& viewpoint, const std::vector<double>& claims,
                                 const JudgeBoundsOptions& options = {});

// For a person, and "clues-motion-judgement/1" (keys sorted; only triangles that are not proved are listed).
std::string to_text(const BoundsReport& report, const scene::DepthMesh& mesh);
std::string to_json_text(const BoundsReport& report, const scene::DepthMesh& mesh);

}  // namespace clues::validate
