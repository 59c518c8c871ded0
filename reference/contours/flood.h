// FIGS. 36, 37, 42 and D26: a map that is not stored, but found again from one that is: a seed for each connected part of
// what is visible, and the segments where it ends. A flood runs from the seeds over what the other map calls visible, and
// stops at these segments.
//
// The known map is that of a cell that holds the wanted one (T6), or of one that holds both cells of a transition. Wanted
// is what the inner cell sees (parent to child), or what either cell sees and the other does not (both rows of Table
// XIV): nothing below asks which.
//
// With all seeds and segments decoding is exact: the flood from a seed stays in its component, for whatever leads out of
// it inside of the known set is a segment; and each component has a seed. Without a segment it may only reach more, and
// without a seed it loses the component and nothing else, unless another flood comes there.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "reference/contours/surface_parts.h"

namespace clues::reference {

struct Seed {
  std::size_t side = 0;
  exact::Point2 at;  // flat; inside of the component
};

struct ContourLabel {
  std::vector<Seed> seeds;            // one for each component
  std::vector<SideSegment> segments;  // where the wanted set ends inside of the known one
};

// `known` and `wanted`: a set for each side, the second inside the first. O(n log n).
ContourLabel contour_label(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                           const std::vector<FlatSet>& known, const std::vector<FlatSet>& wanted);

// What the flood reaches, for each side. O(n log n).
std::vector<FlatSet> flooded(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                             const std::vector<FlatSet>& known, const ContourLabel& label);

// FIG. 42B, hazard A-37: from a small cell what is far away looks nearly as from the larger one. The wanted sets, but on
// sides of triangles that are farther from the cell than `reach` times its diameter the known ones (by boxes around the
// triangle and the cell). So each side is handled by one level exactly, and decoding is conservative there.
std::vector<FlatSet> with_far_sides_of(const std::vector<InputSide>& sides, const scene::TriangleMesh& mesh,
                                       const std::vector<FlatSet>& known, std::vector<FlatSet> wanted,
                                       const exact::ConvexCell& cell, const exact::FT& reach);

}  // namespace clues::reference
