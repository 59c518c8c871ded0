// D4: a piece of the complex has two sides, and a map has an answer for each that counts in its mode. In lists they stand by side_index (first_order.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "reference/visibility/map/visibility_map.h"

namespace clues::reference {

// Of a side_index.
inline std::uint32_t piece_of(std::size_t side) { return static_cast<std::uint32_t>(side / 2); }
inline bool is_front(std::size_t side) { return side % 2 == 0; }

// Whether the front (or back) of a piece counts for an input triangle that it comes from.
inline bool counts(Mode mode, const exact::Origin& origin, bool front) {
  return mode == Mode::sheet || origin.same_side == front;
}

// Whether it counts for any.
inline bool counts(Mode mode, const exact::Piece& piece, bool front) {
  return std::any_of(piece.origins.begin(), piece.origins.end(),
                     [&](const exact::Origin& o) { return counts(mode, o, front); });
}

// Whether some point of the cell is strictly in front of the side. The others are reached by no sight line and no continuation (D8).
inline bool faces_cell(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t piece, bool front) {
  const auto wanted = front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
  return std::any_of(cell.vertices().begin(), cell.vertices().end(),
                     [&](const exact::Point3& v) { return complex.planes[piece].oriented_side(v) == wanted; });
}

}  // namespace clues::reference
