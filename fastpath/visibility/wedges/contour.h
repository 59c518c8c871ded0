// D10, D11: the edges that carry SV-ME and SE-ME wedges, and all supporting planes through edges. By plane sides alone.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/visibility/scene/local_scene.h"
#include "fastpath/visibility/wedges/workers.h"

namespace clues::fastpath {

struct ContourEdge {
  std::uint32_t edge = 0;
  const Plane* plane = nullptr;  // V in the closed negative side H+; so are the pieces at the edge
  std::vector<int> touching;     // cell vertices on the plane, on one side of the edge's line
  const Plane* other = nullptr;  // the other supporting plane through the edge, if there is one and it differs
  bool holds_cell = false;       // all of V lies in the plane: its wedges only separate (T10)
};

// All contour edges, by edge. The workers keep the planes. O(edges * cell vertices).
std::vector<ContourEdge> contour_edges(const LocalScene& scene, Workers& workers);

}  // namespace clues::fastpath
