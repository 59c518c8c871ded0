// One small scene, asked of every kernel, and every answer judged by what shares no algorithm with them: sight lines in plain rationals (D5, D6), point
// occlusion (D18), the exact visible set, and each other (D9, D15). The dials of the case are turned while the kernels work. Nothing is thrown and nothing stops
// at the first flaw.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fastpath/visibility/local_map.h"
#include "fuzz/campaign/finding.h"
#include "reference/visibility/first_order.h"

namespace clues::tests {

// What one kernel says of the scene.
struct KernelAnswer {
  std::string kernel;
  std::vector<std::uint32_t> visible;
  std::uint64_t fallbacks = 0;
  bool first_order = true;                      // promises exactly Omega where it has no fallback; else any sound list
  std::optional<reference::VisibilityMap> map;  // of the reference
  std::optional<std::vector<fastpath::LocalRegion>> regions;  // of the fast path
};

struct JudgeSettings {
  bool refined = false;       // ask the refinements too (D20, D21)
  bool visible_set = false;   // decide the scene completely
  bool no_fallbacks = false;  // in scenes of up to ten triangles, without limits, they are flaws
  std::size_t points_per_region = 3;
  int sight_lines = 6;                               // to each triangle that somebody does not list
  std::vector<std::string> kernels{};                // only these; empty: all
  bool truth = true;                                 // else only the kernels, against each other
  std::function<void(KernelAnswer&)> planted_bug{};  // spoils an answer, or throws; for the tests of the tests
};

struct Flaw {
  std::string category;  // what is wrong, of which kernel
  std::string detail;    // where; the witness
};

struct Judgement {
  std::vector<Flaw> flaws;  // at most one of each category
  std::map<std::string, std::uint64_t> counts;
  double seconds = 0;
};

Judgement judge_scene(const fuzz::Case& scene, const JudgeSettings& settings);

// Without the triangles, and then the corners of the cell, that the flaw does not need.
fuzz::Case shrunk(const fuzz::Case& scene, const JudgeSettings& settings, const std::string& category);

// The scene as an OBJ file, and the cell as `--cell` takes it: "box:..." where it is one, else another OBJ.
std::string to_obj_text(const fuzz::Case& scene);

}  // namespace clues::tests
