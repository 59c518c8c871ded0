// First-order visibility of one cell in a scene of any size: the closure (closure.h) over the engine (local_map.h). The door of the fast path.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/standard_range.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/visibility/closure/closure.h"
#include "fastpath/visibility/map/local_map.h"

namespace clues::fastpath {

struct FirstOrder {
  std::vector<std::uint32_t> visible;  // the PVS (D15): ids of the scene, ascending
  // Ids of the triangles that were mapped, and of dark ones beside them (closure.h), ascending; every visible one is among them.
  std::vector<std::uint32_t> part;
  std::vector<LocalRegion> regions;  // of the part, with ids of the scene, when asked for; all else is hidden
  LocalMapCounts counts;             // of the last map, which without regions may be one of a part of these
  ClosureCounts closure;
  std::uint64_t conservative_fallbacks = 0;
  std::vector<std::uint32_t>
      in_doubt;  // D17b, when asked for: visible triangles of which no point is known to be in Omega or in V
};

// What a map is asked for besides its list.
struct FirstOrderAsked {
  bool regions = false, in_doubt = false;
};

// One tree serves many cells at once. The same answer for any number of threads. Solid mode takes the mesh as
// closed: see require_solid. A scene outside the standard range (exact/cell/standard_range.h) is moved there and
// gets a tree of its own; regions are moved back. Throws scene::Error for coordinates that are not finite,
// and unsupported as StandardRange does.
FirstOrder first_order_visibility(const Bvh& bvh, const std::vector<Point>& cell, const LocalMapOptions& options,
                                  const FirstOrderAsked& asked = {});

// Back into the coordinates of the scene.
void move_back(std::vector<LocalRegion>& regions, const exact::StandardRange& range);

// D4. Throws scene::Error not_solid unless the mesh is closed and consistently oriented. O(n log n) where the triangles share their corners; else as
// slow as exact::build_complex.
void require_solid(const scene::TriangleMesh& mesh);

}  // namespace clues::fastpath
