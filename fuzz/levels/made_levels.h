// Cells in scenes of thousands of triangles: levels that are given, and made ones with what levels have: rooms, panes that do not block, hulls that do not count (D22).
#pragma once

#include <cstdint>
#include <vector>

#include "fuzz/generators/given_scenes.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fuzz {

struct SceneInALevel {
  scene::FlaggedMesh scene;
  std::vector<scene::Point> cell;
};

// Each a pure function of seed, index and what is given. The made ones have 400 to 6,000 triangles; points are moved by nothing, an ulp or 2^-40 to 2^-10 (dial), so that
// neighbours gape and overlap by so much.
SceneInALevel rooms_of_a_level(std::uint64_t seed, std::uint64_t index);
SceneInALevel streets_of_a_level(std::uint64_t seed, std::uint64_t index);

// `levels` must not be empty. A leaf: one of them at least has cells.
SceneInALevel box_in_a_level(const std::vector<GivenLevel>& levels, std::uint64_t seed, std::uint64_t index);
SceneInALevel leaf_of_a_level(const std::vector<GivenLevel>& levels, std::uint64_t seed, std::uint64_t index);

}  // namespace clues::fuzz
