// Proves that a constraint holds in a whole ball around a viewpoint, by branch and bound: the ball is covered by cubes, halved until in each an
// inequality in intervals shows it. Shares no formula with the bounds of the reference (T8, T9): those are inequalities for the whole ball.
#pragma once

#include <array>
#include <cstdint>

#include "scene/motion/constraint.h"
#include "scene/motion/depth_mesh.h"

namespace clues::validate {

struct BallClaim {
  scene::MotionConstraint constraint = scene::MotionConstraint::separation;  // or delaunay
  std::array<const scene::DepthSample*, 4> samples{};                        // as PlaceSamples has them
  scene::MotionPoint center{};
  double sigma = 0;
};

struct BallProof {
  bool proved = false;
  std::uint64_t cubes = 0;
  // The middle of a cube where the inequality fails by itself: a good place to look for a violation.
  bool suspect = false;
  scene::MotionPoint at{};
};

// For every v with |v - center| <= radius. Gives up after `most_cubes`. A separation is proved together with facing: det > 0 is part of it.
BallProof prove_in_ball(const BallClaim& claim, double radius, std::uint64_t most_cubes);

}  // namespace clues::validate
