// What OBJ and PLY files give to vertices and corners besides places: texture coordinates and colours. D1 has no use for them; remeshes carry them
// over.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::scene {

struct MeshAttributes {
  std::vector<std::array<double, 2>> texture;
  std::vector<Triangle>
      texture_corners;  // of each triangle, into `texture`; no_vertex: it has none. Empty: no triangle has
  std::vector<std::array<double, 3>> colours;  // of each vertex, red, green and blue from 0 to 1. Empty: there are none
};

// Of a file that read_mesh() read as `mesh`. OBJ: vt, and v x y z red green blue, where all vertices have colours. PLY: red, green, blue of vertices;
// s and t (or u and v, or texture_u and texture_v) of vertices, or a list texcoord of faces. Other formats: none. Throws Error non_finite,
// index_out_of_range, malformed with file and line, bad_argument if the file has another number of vertices by now. O(size of the file).
MeshAttributes read_attributes(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace clues::scene
