// D15: the exact visibility map, its regions and DM segments.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/cell/standard_range.h"
#include "exact/complex/complex.h"
#include "exact/kernel.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/search/options.h"
#include "reference/visibility/wedges/wedge.h"

namespace clues::reference {

// One face of the arrangement of DM segments on one side of one piece of the complex (D15).
struct Region {
  std::uint32_t piece = 0;
  bool front = true;     // side of the piece (the origins say what that is for the input triangles)
  bool visible = false;  // label (D14)
  std::vector<std::vector<exact::Point3>> rings;  // outer boundary first, then holes
  exact::FT area_fraction;                        // of the piece's own area, exactly
  exact::Point3 sample;                           // the interior point whose label this is
};

struct DmSegment {
  std::uint32_t piece = 0;
  bool front = true;
  bool boundary = false;  // labels differ on its two sides: an OB segment
  exact::Point3 a, b;
};

// What Omega and Bounds hold is in the standard range of the scene (exact/cell/standard_range.h): `range` leads
// back from there. What first_order_visibility returns is in the coordinates of the scene.
struct VisibilityMap {
  exact::Complex complex;
  exact::ConvexCell cell;
  Mode mode = Mode::sheet;
  Formulation formulation = Formulation::plain;
  std::vector<Wedge> wedges;  // the valid pieces
  std::vector<DmSegment> segments;
  std::vector<Region> regions;         // by piece, front before back
  std::vector<std::uint32_t> visible;  // the PVS: input triangle ids, ascending
  Statistics statistics;
  std::string method = "first-order";  // or how it was refined (D20, D21)
  exact::StandardRange range = {};
  // D17b: those of `visible` of which no point is known to be in Omega; ascending. Not of a refined map, nor of a part of a cell.
  std::vector<std::uint32_t> in_doubt = {};
};

// The sides of the pieces of a complex, numbered.
inline std::size_t side_index(std::uint32_t piece, bool front) { return 2 * std::size_t{piece} + (front ? 0 : 1); }

// D3, by input triangle: they are visible, whatever the regions say. The pieces of `scene` are those of `complex`, or some of them.
std::vector<bool> that_meet_cell(const exact::SceneQuery& scene, const exact::Complex& complex);
// D15: the PVS by the map's regions, and D3.
void find_visible(const exact::SceneQuery& scene, VisibilityMap& map);

}  // namespace clues::reference
