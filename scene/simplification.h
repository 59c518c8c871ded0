// What the simplification of a map's occlusion (FIGS. 20B, 30) was asked for, and what it gave up and saved: a part of a result file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scene/result.h"

namespace clues::scene {

struct Simplification {
  struct Figures {
    std::uint64_t occlusion_regions = 0, boundary_segments = 0;
    double hidden_area = 0;  // an estimate, in units of the scene, squared
    std::uint64_t visible_triangles = 0;
  };
  double min_occlusion = 0, simplify_boundaries = 0;
  Figures before, after;
  std::optional<double> intersect_planes;           // degrees
  std::uint64_t inside_corners = 0, by_planes = 0;  // within the angle; of these, used
};

// As for the result alone, with the key "simplification".
std::string to_json_text(const Result& result, const Simplification& simplification);

}  // namespace clues::scene
