// D20 in the fast path: where a view cell is cut for backprojection. The plane is that of an adjusted wedge, through a contour segment s that something obstructs, and
// touching the part V(s) of the cell that s sees. What s sees is found by sight lines and so only approximately, and the plane is chosen among many by an estimate of
// what it gains: by D21 every plane whatever gives a sound bound.
#pragma once

#include <optional>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/map/local_map.h"

namespace clues::fastpath {

struct CutPlane {
  Point base{}, normal{};  // V(s) is on the negative side
};

// A place on a triangle that may be visible, and what it would be worth to know that it is hidden.
struct OpenPlace {
  Point at{};
  double weight = 1;
};

// The plane for this part of the cell, by the wedges of its first-order map. None when no obstructed contour segment has to do with the open places. `cell`: all of V.
// O(w (r + p)) for w wedges, some hundred segment queries r for each, and p places.
std::optional<CutPlane> choose_cut(const std::vector<WedgePiece>& wedges, const exact::ConvexCell& part,
                                   const Cell& cell, const std::vector<OpenPlace>& open, SegmentQueries& queries);

// Two convex parts that cover the cell, the one on the negative side of the plane first, or the cell alone where the plane does not cut it. Each reaches a little beyond
// the plane, so that its corners have short numbers.
std::vector<exact::ConvexCell> parts_along(const exact::ConvexCell& cell, const CutPlane& plane);

}  // namespace clues::fastpath
