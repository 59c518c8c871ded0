// The cases of vectors/motion: small meshes with a viewpoint and thresholds, of which it is known, with proof, which constraints are violated
// and which bounds can be claimed. A closed format, "clues-motion-vectors/1"; vectors/motion/schema.json says the same as this reader.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/motion/constraint.h"
#include "scene/motion/depth_mesh.h"

namespace clues::validate {

// The squared distance to the nearest violation, where it is a fraction: facing, edge length.
struct KnownSquare {
  scene::ConstraintPlace place;
  std::string square;  // "25/16"
};

struct MotionVector {
  std::string file, id, comment;
  scene::DepthMesh mesh;
  scene::MotionPoint viewpoint{};
  scene::MotionThresholds thresholds;
  bool has_expectation = false;
  std::vector<scene::ConstraintPlace> violated;  // at the viewpoint, by triangle
  std::vector<double> sound;                     // by triangle: a bound that is proved
  std::vector<double> unsound;                   // by triangle: one that is refuted; infinite: none is
  std::vector<KnownSquare> exact;
};

struct MotionTopic {
  std::string file, topic;
  std::vector<MotionVector> cases;
};

// Whether `clues lint` of this folder is about motion: its schema says so.
bool is_motion_suite(const std::filesystem::path& folder);
// A case without "expect" is accepted when `drafts`. Throws Error malformed with file and case.
MotionTopic read_motion_topic(const std::filesystem::path& path, bool drafts = false);
MotionTopic parse_motion_topic(std::string_view text, const std::string& file, bool drafts = false);
std::string to_json_text(const MotionTopic& topic);  // the one canonical text

// All cases; no id twice. Throws as above.
std::vector<MotionVector> read_motion_suite(const std::filesystem::path& folder);

}  // namespace clues::validate
