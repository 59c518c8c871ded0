// Which base triangle each piece of an overlay lies in, and which pieces meet at each of its points: what whoever moves a point has to look at.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::reference {

// By piece. Throws Error bad_argument where one lies in no base triangle: the hierarchy is not a verified one. O(n log n).
std::vector<std::uint32_t> base_triangles(const scene::Hierarchy& hierarchy);

struct PiecesAround {
  std::vector<std::uint32_t> base;                 // of each piece
  std::vector<std::vector<std::uint32_t>> pieces;  // at each point

  // Throws as base_triangles().
  explicit PiecesAround(const scene::Hierarchy& hierarchy);
};

}  // namespace clues::reference
