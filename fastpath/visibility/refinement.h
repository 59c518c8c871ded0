// First-order maps refined by cutting the cell (D21) or by backprojection (D20, T4), in the fast path. Conservative by construction.
//
// Theorem. Let V be the view cell, V1..Vk convex sets whose union holds V, S the triangles, and K a part of them. Take from every triangle of K what it has in int V, and let
// Omega_K(Vi) be the first-order visible set of Vi among the rest. Then E(V) is a subset of the union of the Omega_K(Vi).
// Proof. A free segment of E(V) begins at a v in int V, which lies in some Vi; what is beside v in int V and sees the same (free segments are an open set) lies in int Vi or may be chosen to, as
// finitely many closed convex sets that cover int V do so with the closures of those interiors that are of V's dimension. The segment is free of S without what lies in int V (D3), so
// it is free of the less that K has; T1 for Vi and that scene says that its end is in Omega_K(Vi).
//
// So a triangle that no Omega_K(Vi) has a point of is hidden, whatever planes cut V, whatever K is, and although the parts overlap. What must not happen is that a part is left out, that
// is T4 (the adjusted wedge alone is the map of V+, without V-: hazard A-4), or that a part is mapped as a cell of its own, for which what stands in the
// rest of V would hide something (D3). Neither the choice of planes nor the sight lines below can do harm: they are free to be approximate.
//
// K is the part of the scene with a point in Omega(V): Omega(Vi) lies in Omega(V), so by the theorem of closure.h the maps in K are those in S.
// A triangle is open if it is visible to first order and no free sight line to it is known. Only parts that still may see an open triangle are cut, and only open triangles are asked
// about. What stays undecided in a map (D17) counts as visible there.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/visibility/first_order.h"

namespace clues::fastpath {

enum class RefineBy : std::uint8_t { cells, backprojection, both };  // both: adjusted planes first, then cells

// The planted bugs of the tests of the tests. A user never sets one.
enum class RefinementBug : std::uint8_t { none, one_half_only, cells_of_their_own };

struct RefinementOptions {
  RefineBy by = RefineBy::cells;
  int max_depth = 4;          // cuts on the way from V to a part
  double tolerance_area = 0;  // done when the estimated excess is no more than this; 0: when no triangle is open
  bool regions = false;       // refine the regions too
  RefinementBug planted_bug = RefinementBug::none;
};

// The state after one more depth; depth 0 is the first-order map.
struct RefinementFigures {
  bool backprojection = false;  // else cells
  int depth = 0;
  std::uint64_t parts = 1, maps = 0, viewpoints = 0;  // parts that V is cut into; maps and viewpoints so far
  std::uint64_t visible = 0, witnessed = 0;           // triangles: listed; with a free sight line, or meeting V
  double first_order_area = 0, witnessed_area = 0, refined_area = 0;  // estimates; 0 unless areas were asked for
};

struct RefinedVisibility {
  FirstOrder first_order;              // its regions are the refined ones
  std::vector<std::uint32_t> visible;  // the refined PVS: ids of the scene, ascending
  std::vector<RefinementFigures> depths;
  std::uint64_t conservative_fallbacks = 0;  // of all maps of parts
};

// Areas are kept when regions are asked for, or a tolerance is: then viewpoints are mapped for the lower bound, and parts are cut for what is in doubt of triangles that are seen, too.
// The same answer for any number of threads of the current arena. Throws as first_order_visibility does.
RefinedVisibility refined_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                     const RefinementOptions& refinement);

}  // namespace clues::fastpath
