// Walks (D30) as files: what the mesh was at every frame, as JSON lines. The first line names the format; every other is a frame, which says
// only what has changed since the one before, so that a long walk of a large mesh stays small. docs/motion.md has the fields.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "scene/motion/depth_mesh.h"

namespace clues::scene {

// A triangle of three of these is none: a place that is free. Programs that delete triangles in place may leave such places, and the
// indices of the others stay what they are.
inline constexpr std::uint32_t no_sample = std::numeric_limits<std::uint32_t>::max();

// Makes the lines, each with its newline. What stays the same from frame to frame costs a comparison.
class WalkWriter {
 public:
  static std::string header();
  std::string frame(const DepthMesh& mesh, const MotionPoint& viewpoint, const MotionThresholds& thresholds);

 private:
  DepthMesh last_;
  MotionThresholds last_thresholds_;
  bool first_ = true;
};

struct WalkFrame {
  std::uint64_t number = 0;  // from 0
  MotionPoint viewpoint{};
  MotionThresholds thresholds;
  DepthMesh mesh;  // free places left out; samples that no triangle names stay
};

// Throws Error: file_not_found, file_unreadable; malformed, non_finite, index_out_of_range with file and line.
class WalkReader {
 public:
  explicit WalkReader(const std::filesystem::path& path);
  bool next(WalkFrame& frame);  // false at the end

 private:
  std::string file_;
  std::ifstream input_;
  std::uint64_t line_ = 0, frames_ = 0;
  DepthMesh mesh_;
  MotionThresholds thresholds_;
};

}  // namespace clues::scene
