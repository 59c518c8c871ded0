// Looks for a viewpoint strictly inside of a ball that violates a constraint. What is returned was confirmed with exact predicates; that
// nothing is returned proves nothing.
#pragma once

#include <optional>
#include <vector>

#include "validate/motion/mesh_places.h"

namespace clues::validate {

struct BallQuestion {
  scene::MotionConstraint constraint = scene::MotionConstraint::facing;
  std::array<const scene::DepthSample*, 4> samples{};  // as PlaceSamples has them
  scene::MotionPoint center{};
  double radius = 0;  // positive; infinite: anywhere
};

// `hints`: viewpoints worth trying first.
std::optional<exact::ExactViewpoint> find_violation(const BallQuestion& question,
                                                    const exact::ExactThresholds& thresholds,
                                                    const std::vector<scene::MotionPoint>& hints = {});

}  // namespace clues::validate
