// FIG. 30C on the surface that receives the shadow: a hidden region with a simpler border that lies within the old, closed one. The published text collapses edges
// of the silhouette contour, in space, and believes the outcome (hazards ); here a step is taken only if the triangle that it gives up is
// hidden, all of it. Either kind of step saves one segment:
//
//   cut     a corner that points out of the region goes, for the chord between its neighbours (30.20);
//   extend  a segment goes, and the segments before and after it are extended until they meet (30.29).
//
// What lies on the outline of the triangle stays, so that neighbouring triangles still agree about the edge between them.
#pragma once

#include <cstddef>

#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

// The segments of the face's rings that do not lie on the outline.
std::size_t boundary_segments(const Face2& face, const exact::Kernel::Triangle_2& outline);

// Takes the step that loses least, ties by position, until the next would make the loss (as doubled area) more than `budget`. So a larger budget continues what a
// smaller one began. The hidden face must have no corner in the middle of one of its other segments. A ring of three corners stays as it is. Each step O(n^2) for n
// corners at worst, O(n log n) where the first choice will do.
Face2 simplified(const Face2& face, const exact::Kernel::Triangle_2& outline, const exact::FT& budget);

}  // namespace clues::reference
