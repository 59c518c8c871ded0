// FIG. 12: the umbral discontinuity mesh (CLUDM): the regions of the map (D15) with shared vertices, and edges that know the regions on both sides. Edges
// on the border of a piece of the complex have one side; pieces are not sewn together across their borders.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

struct DiscontinuityMesh {
  std::vector<exact::Point3> vertices;                         // in lexicographic order
  std::vector<std::vector<std::vector<std::uint64_t>>> faces;  // one for each region of the map, its rings
  struct Edge {
    std::uint64_t a = 0, b = 0;
    std::uint64_t left = 0;              // the face whose ring runs from a to b
    std::optional<std::uint64_t> right;  // a < b then; none: a border
    bool boundary = false;               // the labels differ: an OB segment
  };
  std::vector<Edge> edges;  // by left face, in the order of its rings
};

// O(n log n).
DiscontinuityMesh discontinuity_mesh(const VisibilityMap& map);

}  // namespace clues::reference
