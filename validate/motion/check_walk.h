// The checker of whole walks (D30): at every frame, is the mesh a depth mesh (T7) and does every constraint hold? Everything is looked at
// in every frame; intervals decide what they can and integers the rest. Knows nothing of bounds, bins or odometers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/motion/constraint.h"
#include "scene/motion/walk_file.h"

namespace clues::validate {

enum class WalkFault : std::uint8_t { constraint, open_mesh, covered_twice };

struct WalkFinding {
  std::uint64_t frame = 0;
  WalkFault fault = WalkFault::constraint;
  std::string what;  // for a person: "triangle 12: length of the edge 3-4"
};

struct WalkReport {
  std::uint64_t frames = 0, triangles = 0;  // sum over the frames
  std::uint64_t tested = 0;                 // constraints
  std::uint64_t by_integers = 0;            // of those: not decided by intervals
  std::array<std::uint64_t, 4> violated{};  // by constraint
  std::uint64_t open_frames = 0, overlapping_frames = 0;
  std::vector<WalkFinding> findings;  // the first 100
  bool sound() const;
};

// Of one frame; adds to the report.
void check_frame(const scene::WalkFrame& frame, WalkReport& report);

// Throws Error as WalkReader. A walk without frames is an Error malformed: nothing was checked.
WalkReport check_walk(const std::filesystem::path& path,
                      const std::function<void(std::uint64_t frames)>& progress = {});

std::string to_text(const WalkReport& report);
std::string to_json_text(const WalkReport& report);  // "clues-walk-report/1"

}  // namespace clues::validate
