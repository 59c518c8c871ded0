// E4 and E6 for any two surfaces: that a set of pieces is a common triangulation of both, and so a homeomorphism (T11).
#pragma once

#include <string>
#include <vector>

#include "validate/multires/check_hierarchy.h"

namespace clues::validate {

struct CommonTriangulation {
  const std::vector<scene::Triangle>& first;   // that of the sources
  const std::vector<scene::Triangle>& second;  // that of the images
  const std::vector<scene::OverlayVertex>& points;
  const std::vector<scene::OverlayTriangle>& pieces;
  std::string first_name, second_name;    // "the input"
  std::string weight_check, cover_check;  // what findings are filed under
};

// Of each piece the triangle of the second surface that its corners span; no_vertex: none, which is among what is found.
std::vector<std::uint32_t> check_common_triangulation(const CommonTriangulation& parts, HierarchyReport& report);

}  // namespace clues::validate
