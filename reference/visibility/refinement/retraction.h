// Silhouette retraction. Seen from the point of V(s) that an adjusted plane touches, both surfaces at the edge may turn their backs: then the plane runs between them, the edge is
// no silhouette from there, and the event surface belongs to an edge of the same surface nearer to V. With the option the plane of that edge is cut along as well; what is
// called hidden rests on the maps of the halves as ever (T4, D21).
//
// Without it little is lost: where that edge is a silhouette for the half V+, the map of V+ has its wedges (D10 for the half). Nor is anything left out of the occluders to keep a plane
// clear of its own surface (hazard A-32): what of a mesh stands before its own edge hides V from it, and V(s) ends there. Only edge-on pieces hide nothing.
#pragma once

#include <optional>

#include "reference/visibility/refinement/backprojection.h"

namespace clues::reference {

// Whether pieces at the edge lie strictly on both sides of the plane through it.
bool runs_into_surface(const exact::Complex& complex, std::uint32_t edge, const exact::Plane3& plane);

// Of the edges of the pieces at the segment's edge the one whose middle is nearest to the cell's centre, as a segment; none if it is not nearer than the segment's
// own middle, or if its line meets the inside of the cell.
std::optional<ContourSegment> nearer_edge(const exact::Complex& complex, const ContourSegment& segment,
                                          const exact::ConvexCell& cell);

}  // namespace clues::reference
