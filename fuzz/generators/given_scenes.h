// Scenes made of what the user gives: pieces of large meshes, and mutations of small scenes. Pure functions of seed, index and the given scenes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/generators/random_scenes.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::fuzz {

struct GivenScene {
  std::string name;
  scene::TriangleMesh mesh;
  std::vector<scene::Point> cell;  // empty: none was given
};

// A scene with flags (D22) to be seen from cells of its own; without any, from boxes.
struct GivenLevel {
  std::string name;
  scene::FlaggedMesh scene;
  std::vector<std::vector<scene::Point>> cells;
};

struct GivenScenes {
  std::vector<GivenScene> meshes;  // of more than 40 triangles
  std::vector<GivenScene> small;
  std::vector<GivenLevel> levels;
  std::vector<std::string> paths;  // as they were given
  std::string hashes;              // SHA-256 of each file, in the order of reading
};

// Two or three patches of neighbouring triangles, cut from the meshes, thinned out (the dial: 0 none, 7 half of them), and scattered: at most 40
// triangles in all. The cell is a box beside or among them. The meshes must not be empty.
GeneratedScene mesh_pieces(const std::vector<GivenScene>& meshes, std::uint64_t seed, std::uint64_t index);

// One of the scenes (or, where there is none, a random one) after 1 to 8 (dial) changes: corners moved, aligned, merged; triangles removed, repeated,
// turned, added; points of the cell moved.
GeneratedScene mutations(const std::vector<GivenScene>& scenes, std::uint64_t seed, std::uint64_t index);

}  // namespace clues::fuzz
