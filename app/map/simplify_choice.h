// clues map: how far occlusion may be given up for fewer boundary segments (FIGS. 20B, 30).
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "reference/visibility/hidden/effective_occlusion.h"
#include "scene/simplification.h"

namespace clues::app {

struct SimplifyChoice {
  std::optional<double> min_occlusion, simplify_boundaries, intersect_planes;

  void add_to(CLI::App& command);
  void check() const;  // throws Error bad_argument
  bool asked() const { return min_occlusion || simplify_boundaries || intersect_planes; }
  reference::OcclusionControls to_reference(int threads) const;
};

scene::Simplification record_of(const reference::SimplifiedMap& simplified, const SimplifyChoice& choice);

// One line.
std::string summary_of(const reference::SimplifiedMap& simplified, const scene::Simplification& record);

}  // namespace clues::app
