// A scene from a file of any format: those of scene/mesh_io.h, in which all triangles block and count, and those that know better
// (D22): glTF (.gltf, .glb) and levels (.bsp).
#pragma once

#include <filesystem>
#include <optional>

#include "scene/levels/bsp_file.h"
#include "scene/mesh/flagged_mesh.h"

namespace clues::scene {

inline constexpr const char* scene_formats = "OBJ, OFF, PLY, STL, glTF (.gltf, .glb) or a level (.bsp)";  // for --help

// By the file's extension. Throws as read_mesh, and for the others malformed, unsupported, non_finite, index_out_of_range. At least one triangle counts.
FlaggedMesh read_scene(const std::filesystem::path& path);

// The level, where the file is one by its extension (.bsp), for whoever asks more of it than its scene (scene_of_level). Throws as parse_bsp.
std::optional<BspFile> read_level(const std::filesystem::path& path);

// For whoever takes every triangle for opaque and asks about each. Throws Error unsupported for a scene in which one does not block, or does not count:
// to take it for opaque would hide what is seen.
TriangleMesh read_plain_scene(const std::filesystem::path& path);

// What is drawn of a scene: its triangles that count, whether they block or not, with all of its points. Throws as read_scene.
TriangleMesh read_drawn_scene(const std::filesystem::path& path);

}  // namespace clues::scene
