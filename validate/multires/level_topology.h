// E1: a list of triangles is a surface with boundary, and which: asked of OpenMesh, whose half-edge mesh takes a triangle only where it fits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::validate {

struct LevelTopology {
  std::string defect;  // empty: none
  std::int64_t vertices = 0, edges = 0, triangles = 0;
  std::int64_t boundaries = 0;  // loops
  std::int64_t euler() const { return vertices - edges + triangles; }
};

// Of the vertices that triangles use, below `vertices`. O(n).
LevelTopology topology_of(const std::vector<scene::Triangle>& triangles, std::size_t vertices);

// What half-edges do not mind: vertices that no triangle uses, ascending; and a triangle whose three vertices another one has too.
std::vector<std::uint32_t> vertices_without_triangle(const std::vector<scene::Triangle>& triangles,
                                                     std::size_t vertices);
std::optional<scene::Triangle> triangle_there_twice(std::vector<scene::Triangle> triangles);

}  // namespace clues::validate
