// D24, FIGS. 33, 39, 40: from one cell to the next. The unified map of two cells cuts every side of every input
// triangle into what neither, the one, the other or both of them see; the two middle ones are the regions of the delta:
// newly hidden (DR_O) and newly visible (DR_E). All of it is exact.
//
// A viewer who walks from one cell to the other without leaving their union is in one of them at every moment, and on a
// shared face in both. So the two maps are enough, whether or not the union is convex (hazard A-25); a map of its hull
// may hold more than both.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/delta/input_sides.h"
#include "reference/delta/sewn_mesh.h"
#include "reference/visibility/search/options.h"

namespace clues::reference {

enum class SeenFrom : std::uint8_t { neither, from, to, both };

// A maximal connected part of one side of an input triangle with one label.
struct UnifiedRegion {
  InputSide side;
  SeenFrom seen = SeenFrom::neither;
  Rings3 rings;             // counter-clockwise from that side
  exact::FT area_fraction;  // of the triangle's area
};

// The packets of the transition (FIG. 31D), as lists of input ids, ascending. A triangle that meets a cell is seen from
// it (D3), whatever its regions.
struct DeltaPackets {
  std::vector<std::uint32_t> plus, minus;  // visible from `to` alone, from `from` alone
};

struct Delta {
  std::uint64_t input_triangles = 0;
  std::vector<std::uint32_t> visible_from, visible_to;  // the PVS of the two cells
  DeltaPackets packets;
  std::vector<UnifiedRegion> regions;  // by side, then by label
  std::uint64_t fallbacks = 0;         // of both maps (D17)
};

DeltaPackets packets_of(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to);

// The unified map of the sides, of which `from` and `to` are the sets. In the coordinates of the mesh.
std::vector<UnifiedRegion> unified_map(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                       const std::vector<FlatSet>& from, const std::vector<FlatSet>& to);

// Two first-order maps and their unified map, in the coordinates of the scene. Throws as first_order_visibility does.
Delta delta_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& from, const exact::ConvexCell& to,
               const Options& options);

}  // namespace clues::reference
