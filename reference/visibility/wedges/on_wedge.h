// D13: what is valid on a wedge: an exact radial lower envelope (replaces the 2D traversal of FIGS. 14-16).
//
// Seen from the centre c of a planar radial sector, every piece that reaches into the open H- and meets the plane is a segment; the nearest
// one beyond the near bound ends the wedge there. Pieces that lie in H+, or in the plane itself, do not block (one-sided limit), nor
// does anything between the cell and the near bound (hazard B-18). Segments seen edge-on block one ray only, which is nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/planar/plane_frame.h"

namespace clues::reference {

// A point of the wedge's plane, in space and flat.
struct Spot {
  exact::Point3 p;
  exact::Point2 q;
};

// A planar radial sector: from a mesh edge (near0, near1; centre: a cell vertex) or from an apex (near0 = near1 = center).
struct Sector {
  exact::Plane3 plane;  // V in the closed negative side
  exact::Point3 center;
  exact::Point3 near0, near1;           // counter-clockwise about the normal as seen from center
  exact::Point3 on_ray0, on_ray1;       // points of the bounding rays
  std::vector<std::uint32_t> on_plane;  // points of the complex known to lie in the plane (saves exact zero tests)
  bool from_apex() const { return near0 == near1; }
};

struct Blocker {
  std::uint32_t piece = 0;
  Spot u, w;  // counter-clockwise
};

// A maximal angular interval with one nearest blocker (or none).
struct Strip {
  Spot on_ray0, on_ray1;
  std::optional<std::uint32_t> blocker;  // index into OnWedge::blockers
};

// Where a mesh edge crosses the plane, or a mesh vertex lies in it, inside the sector and beyond the near bound: a CSV wherever
// a valid strip reaches it (FIG. 11A).
struct Crossing {
  bool at_vertex = false;
  std::uint32_t id = 0;  // edge or point of the complex
  Spot at;
};

// The trace of a piece that is seen edge-on from the centre. It blocks one ray, which is nothing, but the wedge cuts both sides of the
// piece along it. u is nearer to the centre (or the centre itself).
struct Radial {
  std::uint32_t piece = 0;
  Spot u, w;
};

struct OnWedge {
  PlaneFrame frame;
  exact::Point2 center;
  std::vector<Strip> strips;  // counter-clockwise, covering the sector
  std::vector<Blocker> blockers;
  std::vector<Radial> radials;
  std::vector<Crossing> crossings;             // by edge, then vertices
  std::vector<std::uint32_t> coplanar_pieces;  // pieces in the plane that may meet the sector
  std::vector<std::uint32_t> coplanar_edges;   // edges in the plane that may meet it
};

// O(m log m) for the m pieces that meet the sector's plane within its bounds.
OnWedge on_wedge_visibility(const Sector& sector, const exact::SceneQuery& scene);

// Whether q, at an angle inside the closed sector of the strip, is not beyond the strip's blocker.
bool reaches(const OnWedge& wedge, const Strip& strip, const exact::Point2& q);

// The strips of the angular interval [lo, hi] of rays through these spots.
std::vector<Strip> strips_between(const OnWedge& wedge, const Spot& lo, const Spot& hi);

// Where the ray from the wedge's centre through `on_ray` meets the blocker's line.
exact::Point3 far_point(const OnWedge& wedge, const Blocker& blocker, const Spot& on_ray);

}  // namespace clues::reference
