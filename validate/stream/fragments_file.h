// The visible regions of a map as a sewn mesh (reference/delta/fragments.h), as files: exact (*.json,
// "clues-fragments/1") or with coordinates rounded to doubles (*.obj, *.ply) or to floats about a double (*.glb).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/delta/input_sides.h"
#include "reference/visibility/map/visibility_map.h"

namespace clues::validate {

// Where input triangles coincide it stands for the first that counts.
struct FileFragment {
  std::array<std::uint64_t, 3> corners{};  // counter-clockwise from the side
  std::uint32_t triangle = 0;
  bool front = true;
};

struct FragmentsRecord {
  std::string scene_file, scene_sha256;
  std::uint64_t scene_triangles = 0;
  std::vector<exact::Point3> exact;     // in the coordinates of the scene
  std::vector<scene::Point> rounded;    // to about the nearest doubles
  std::vector<FileFragment> fragments;  // by triangle, fronts first
};

// The map may be in its own range. File and hash are left to the caller. O(n log n).
FragmentsRecord fragments_of(const reference::VisibilityMap& map);

// Of sets on the sides of triangles, in the coordinates of the scene.
FragmentsRecord fragments_of(const scene::TriangleMesh& mesh, const std::vector<reference::InputSide>& sides,
                             const std::vector<reference::FlatSet>& sets);

std::string to_obj_text(const FragmentsRecord& record);  // a group for each side of each triangle
std::string to_ply_text(const FragmentsRecord& record);  // faces have "triangle", and "back": 0 or 1
std::string to_json_text(const FragmentsRecord& record);
// Throws Error unsupported where single floats are too small for the scene, or 4 GiB for the file.
std::string to_glb_bytes(const FragmentsRecord& record);

// As the file is called: *.obj, *.ply, *.glb, and JSON otherwise.
std::string to_bytes_of(const FragmentsRecord& record, const std::filesystem::path& file);

}  // namespace clues::validate
