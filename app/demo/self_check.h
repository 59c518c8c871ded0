// `clues demo` does not believe itself: three ways in which a wrong map would show.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "reference/visibility/first_order.h"
#include "scene/mesh/mesh.h"
#include "validate/verdicts/judge.h"

namespace clues::app {

struct SelfCheck {
  std::uint64_t hidden_points = 0;       // points of hidden regions put to the point-occlusion oracle (D18)
  std::uint64_t hidden_points_seen = 0;  // must be 0
  std::uint64_t sight_lines = 0;         // random exact sight lines to hidden regions (D5)
  std::uint64_t sight_lines_free = 0;    // must be 0
  validate::Judgement own;               // the verdict on the map's own PVS: must be sound, without contradictions
  bool loss_is_caught = false;           // ... and on the PVS without one visible triangle: must be unsound
  bool passed() const;
};

using CheckProgress = std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

// `effort`: how many hidden regions are looked at, spread evenly over the map. The random choices follow `seed`.
SelfCheck check_map(const scene::TriangleMesh& mesh, const reference::VisibilityMap& map, std::uint64_t effort,
                    std::uint64_t seed, const CheckProgress& progress);

}  // namespace clues::app
