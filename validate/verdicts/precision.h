// The sandwich report (D21): witnessed area <= true area <= refined area <= first-order area, per triangle and in total, and what each depth of refinement
// cost and gained. The fractions per triangle are exact; areas are estimates in doubles.
#pragma once

#include <string>
#include <vector>

#include "reference/visibility/refinement/subdivision.h"

namespace clues::validate {

enum class Refinement { none, cells, backprojection, both };  // both: adjusted planes first, then cells

struct PrecisionReport {
  Refinement refinement = Refinement::cells;
  std::vector<reference::DepthFigures> depths;  // for `both` the depths of the second follow those of the first
  std::vector<reference::TriangleBounds> triangles;
  std::uint64_t fallbacks = 0;      // D17
  exact::StandardRange range = {};  // of the areas
};

// Refines the bounds and reports.
PrecisionReport refine(reference::Bounds& bounds, Refinement refinement, const reference::RefineOptions& options);

const char* name_of(Refinement refinement);  // "none", "cell", "backprojection", "both"

std::string to_table(const PrecisionReport& report);
std::string to_json_text(const PrecisionReport& report, const std::string& scene_file, const std::string& scene_sha256);
// Excess area against depth.
std::string to_svg(const PrecisionReport& report);

}  // namespace clues::validate
