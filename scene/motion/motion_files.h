// Depth meshes (D28) and motion bounds (D29) as files that other programs can write: JSON, docs/motion.md has every field. Doubles are
// written with as few digits as give the same double back.
#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/motion/depth_mesh.h"

namespace clues::scene {

// One bound a triangle of a mesh: nearer to the viewpoint than that, no viewpoint violates a constraint of the triangle. Infinite: none
// does anywhere.
struct MotionBounds {
  std::optional<MotionPoint> viewpoint;  // where they are said to hold, if the file says it
  MotionThresholds thresholds;
  std::vector<double> bounds;
};

// "clues-depth-mesh/1". Checks that coordinates are finite, directions not zero, triangles of three different samples that exist. Whether
// the mesh is valid is not asked. Throws Error as read_json_file, malformed, non_finite, index_out_of_range.
DepthMesh read_depth_mesh(const std::filesystem::path& path);
std::string to_json_text(const DepthMesh& mesh);

// "clues-motion-bounds/1". Throws as above.
MotionBounds read_motion_bounds(const std::filesystem::path& path);
std::string to_json_text(const MotionBounds& bounds);

// The pieces, for files that hold them: throw Error malformed that begins with `where`.
DepthSample sample_of(const nlohmann::json& value, const std::string& where);  // [x, y, z] or [x, y, z, KIND]
MotionPoint motion_point_of(const nlohmann::json& value, const std::string& where);
MotionThresholds thresholds_of(const nlohmann::json& value, const std::string& where);
DepthMesh depth_mesh_of(const nlohmann::json& samples, const nlohmann::json& triangles, const std::string& where);
double bound_of(const nlohmann::json& value, const std::string& where);  // null: infinite

std::string to_text(const DepthSample& sample);           // as sample_of reads it
std::string to_text(const MotionPoint& point);            // [x, y, z]
std::string to_text(const MotionThresholds& thresholds);  // {"delaunay": ..., "kappa": ..., "sigma": ...}
std::string bound_to_text(double bound);

}  // namespace clues::scene
