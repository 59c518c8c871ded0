// D20, T4: refinement by backprojection (FIGS. 22-24C, 28), organised so that it cannot hide anything that is visible.
//
// A contour segment s with something between it and the cell sees only a part of V. That part is found by the first-order method itself,
// with s as the source: the corners of what it sees on V's surface span V(s), a convex superset of what it sees. The plane through
// s that touches V(s), and not V, is the plane of the adjusted wedge. It cuts V into V+, with V(s), and V-.
//
// The adjusted wedge is a first-order wedge of V+, no more. What it calls hidden is hidden from V+ (T2), and has to be proved hidden from V- as
// well (T4; raw adjusted wedges hide visible geometry, hazard A-4). So what is accepted as hidden is what the maps of V+ and of V- both call
// hidden: V-'s own wedges, of the occluders between s and V-, are the cut that makes the wedge a UBP. By D21 every plane whatever gives a sound bound this way;
// which plane is chosen decides what is gained, never whether the answer is right. What s sees is therefore computed without the triangles whose planes hold s:
// they hide nothing from it (hazards ). Where s sees nothing of V (hazard A-11) its wedge is left as it is: what hides s has segments of its own. Neighbouring segments need no
// joining pieces of their own (FIG. 24C, hazards ): the halves are cells, and their maps have the SE-MV wedges that close their umbrae.
#pragma once

#include <optional>
#include <vector>

#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"

namespace clues::reference {

// A part of a contour edge that looks at V only past something else (FIG. 27), and its first-order wedge's plane.
struct ContourSegment {
  std::uint32_t edge = 0;  // of the complex
  exact::Point3 lo, hi;
  exact::Plane3 plane;   // V in the closed negative side
  exact::Point3 center;  // the cell vertex that it touches (SVV)
};

// The obstructed segments behind the SV-ME and SE-ME wedges that leave something on an open side in H-; neighbours joined, the order deterministic.
std::vector<ContourSegment> inexact_segments(const VisibilityMap& map, const std::vector<bool>& open);

// Points that span a convex superset of what the segment sees of V: the corners of the visible regions on V's surface. For a flat V of its one facet. Empty: it
// sees nothing. A cell that is a segment or a point has no surface: all its vertices.
std::vector<exact::Point3> seen_by_segment(const exact::Complex& complex, const ContourSegment& segment,
                                           const exact::ConvexCell& cell, const Options& options);

// The plane through the segment that touches what it sees, turned from the wedge's own plane towards V; V(s) in the closed negative side. The wedge's own plane if that
// touches V(s) already; none if nothing is seen.
std::optional<exact::Plane3> adjusted_plane(const ContourSegment& segment, const std::vector<exact::Point3>& seen,
                                            const exact::ConvexCell& cell);

// Depth by depth, adjusted_cuts.cpp: V is cut by the adjusted planes of the inexact segments of its first-order map, and what both halves call hidden is hidden. The halves
// are cells, with inexact segments of their own, and are cut by the same rule at the next depth: what T4 asks of V- is the same question again. A segment is halved for
// the next depth whether its plane cut anything or not: the planes of its parts converge to the quadric through edge, obstacle and cell, from the safe side.
// Depth 0 is the first-order map; `cells` counts the halves too.
std::vector<DepthFigures> refine_by_backprojection(Bounds& bounds, const RefineOptions& options,
                                                   const DepthReport& report = {});

}  // namespace clues::reference
