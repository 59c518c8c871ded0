// D21: refinement by cutting the cell. E(V) is the union of the E(Vi), and so lies in the union of the Omega(Vi).
//
// Geometry inside V does not occlude for the parts either (D3 is about V), also where it lies outside Vi: all parts are mapped in
// the complex that was cut for V. With each Vi as a cell of its own, what stands in V would hide things from Vi that are in E(V).
#pragma once

#include <functional>
#include <vector>

#include "reference/visibility/refinement/bounds.h"

namespace clues::reference {

struct RefineOptions {
  int max_depth = 4;          // cuts on the way from V to a part
  double tolerance_area = 0;  // done when the estimated excess is no more than this, in units of the scene, squared
  bool retract = false;       // by backprojection: retraction.h
};

// The state after one more depth; cells: the parts that V is cut into.
struct DepthFigures {
  int depth = 0;
  std::uint64_t cells = 1, maps = 0, viewpoints = 0;
  AreaEstimate area;
  std::uint64_t backprojections = 0;  // maps of what a segment sees of the cell
};

using DepthReport = std::function<void(const DepthFigures&)>;

// Cuts again and again all parts that may still see more than is known to be seen. Depth 0 is the first-order map.
std::vector<DepthFigures> refine_by_cells(Bounds& bounds, const RefineOptions& options, const DepthReport& report = {});

}  // namespace clues::reference
