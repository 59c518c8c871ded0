// The two scenes of `clues demo`: real meshes between walls, and a generated city block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::app {

struct DemoScene {
  std::string name;  // also the stem of its files
  std::string title;
  scene::TriangleMesh mesh;
  std::vector<scene::Point> cell;  // eight corners of a box
};

// elephant.off, cow.off and bull.off from `mesh_dir`, simplified to about `triangles_each`, behind a wall with a doorway. Throws Error
// file_not_found, with what to do, when a mesh is not there.
DemoScene animals_scene(const std::filesystem::path& mesh_dir, std::uint32_t triangles_each);

DemoScene city_scene(std::uint32_t triangles, std::uint64_t seed);

// The corners' bounds as the user would write them: "box:x0,y0,z0,x1,y1,z1".
std::string box_spec(const std::vector<scene::Point>& corners);

}  // namespace clues::app
