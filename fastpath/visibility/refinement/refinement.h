// First-order maps refined by cutting the cell (D21) or by backprojection (D20, T4), in the fast path. Conservative by construction.
//
// Theorem. Let V be the view cell, V1..Vk convex parts of V that cover it, S the triangles, and K some of them. Take from every triangle of K what it has in int V, and let
// Omega_K(Vi) be the first-order visible set of Vi among the rest. Then E(V) lies in the union of the Omega_K(Vi).
// Proof. Take a free segment of E(V), from v in int V. What is near v sees its end too (free sight lines form an open set), and the Vi of V's own dimension cover
// all of V, as finitely many closed sets of which the others are nowhere dense in it: so v may be moved into int Vi for one of them. The segment meets nothing of S outside int V (D3),
// and so nothing that was kept of K: its end is in E_K(Vi), and by T1 in Omega_K(Vi).
//
// So a triangle is hidden if no Omega_K(Vi) has a point of it, whatever planes cut V, whatever K is, and although the parts overlap a little. What must not happen is that a part
// is left out: the map of V+ alone is the raw adjusted wedge, and V- the proof that T4 asks for (hazard A-4). Neither the choice of planes nor the sight lines below
// can do harm; so they may be approximate.
//
// K is the part that the first-order map was made of: Omega(Vi) lies in Omega(V), so by the theorem of closure.h the maps in K are those in S. (The triangles with a point in Omega(V) would be
// enough for the theorem, but at a mesh vertex the engine goes by all triangles that meet there: without the hidden ones its map has a little too much.)
// A triangle is open if it is visible to first order, no free sight line to it is known, and the map of no point of V that was tried shows it (such maps are exact). Only parts that still may see an open triangle are cut, and only open triangles are asked
// about. What stays undecided in a map (D17) counts as visible there.
//
// Backprojection cuts V, and then every part by the wedges of its own map: for V+ and V- alike the question is asked again, as T4 has it for V-, down to max_depth.
#pragma once

#include <cstdint>
#include <vector>

#include "fastpath/visibility/first_order.h"

namespace clues::fastpath {

enum class RefineBy : std::uint8_t { cells, backprojection, both };  // both: adjusted planes first, then cells

struct RefinementOptions {
  RefineBy by = RefineBy::cells;
  int max_depth = 4;          // cuts on the way from V to a part
  double tolerance_area = 0;  // done when the estimated excess is no more than this; 0: when no triangle is open
  bool regions = false;       // refine the regions too
  // Tried to each triangle before the first depth, and a quarter as many after each. 0: all triangles are asked about in the maps of all parts.
  int sight_lines = 512;
};

// The state after one more depth; depth 0 is the first-order map.
struct RefinementFigures {
  bool backprojection = false;  // else cells
  int depth = 0;
  std::uint64_t parts = 1, maps = 0, viewpoints = 0;  // parts that V is cut into; maps and viewpoints so far
  std::uint64_t visible = 0, witnessed = 0;           // triangles: listed; certainly visible
  double first_order_area = 0, witnessed_area = 0, refined_area = 0;  // estimates; 0 unless areas were asked for
};

struct RefinedVisibility {
  FirstOrder first_order;              // its regions are the refined ones
  std::vector<std::uint32_t> visible;  // the refined PVS: ids of the scene, ascending
  std::vector<RefinementFigures> depths;
  std::uint64_t conservative_fallbacks = 0;  // of all maps of parts
};

// Areas are kept when regions are asked for, or a tolerance is: then parts are cut also for what is in doubt of triangles that are seen.
// The same answer for any number of threads of the current arena. Throws as first_order_visibility does.
RefinedVisibility refined_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                     const RefinementOptions& refinement);

}  // namespace clues::fastpath
