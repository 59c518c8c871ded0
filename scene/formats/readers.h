// One reader for each format. `file` is for messages only. They allow a file without faces (a cell, D2); that a scene has
// triangles is checked in read_mesh. Errors as in scene/mesh_io.h.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/mesh/mesh.h"

namespace clues::scene {

TriangleMesh read_obj(std::string_view bytes, const std::string& file);
TriangleMesh read_off(std::string_view bytes, const std::string& file);
TriangleMesh read_ply(std::string_view bytes, const std::string& file);
TriangleMesh read_stl(std::string_view bytes, const std::string& file);

// By the file's extension; possibly without triangles.
TriangleMesh read_mesh_or_points(const std::filesystem::path& path);

}  // namespace clues::scene
