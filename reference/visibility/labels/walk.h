// D14: the label of a point by walking from the cell towards it (FIG. 25 with the missing rule 3, hazards A-3 and B-9).
//
// A walk does not need the wedges: from p it looks for a sight line to a random point v of int V. If nothing is crossed, p is visible
// outright. Otherwise the last crossing m and p bound a leg, and the walk goes on from m, on the side that faces p, with a v strictly on that side.
// It ends at the cell (visible) or at a surface that the cell does not face (hidden). The label is: visible if the walk ends
// at the cell, or if any leg crosses a valid wedge piece from H+ to H-, or if one lies upon the surface where a leg starts.
// A walk into a groove that no point of V looks into along its edge would go on for ever, from one wall to the other, towards the
// edge: T3 orders points, but an order of points may descend without end (definition, D14 says the recursion ends). Beside the edge all is hidden, though, and the
// walk ends there, with a leg from the edge. For over the edge stands a tent that nothing enters: the walls are its sides, and at either end of the edge it has a plane
// through that end with V and the tent on one side (T2). The planes exist if V and the closed groove share no point, or none but points of the edge: let f be linear, positive in
// the groove, zero on the edge and at most zero on V; let s be linear, on the edge's line the distance from the end, and at least zero where V has f = 0 (for the f of a closed end, if the other is). As V is a
// polytope, f <= k s holds on V where s < 0, for some k > 0; then f - r s is at most zero on V for all r in [0,k], and the less r is, the flatter is the tent.
// Edges that carry both walls on along the line, without a notch between their pieces, count as one edge. Where V touches the line elsewhere, sight lines nearly along the edge come in at the
// groove's end, past the walls, however near the edge p is: then the walk looks that way. Unless something closes that end, as a ceiling does over two walls: let f be positive on the border of
// the local face there that is next to the edge in the groove, but for the edge, and let this face come to the edge in the groove alone. (A face that also comes to it behind a wall is open where what stands
// there ends further on: Found.AFinBehindTheWallOfAGroove.) Then all of that face is where f is positive, and what of it is between the end and a plane f = c, for a small c, is next to the end or in the groove: a
// tent that nothing enters from V, where f is at most zero (corner.h). No plane through this end is needed then.
//
// With a segment as cell, all of a walk lies in one plane with it, a slice, and what is seen there is a matter of the slice
// alone: no sight line leaves it, no continuation, and no wedge that only separates (T10) divides it. So such a walk ends by
// T2 in the slice. Its walls are two rays from the tip y of the groove, and if a line of the slice through y has V on one side
// and both rays strictly on the other, then next to y all between them is hidden: a parallel line just beyond y cuts a
// triangle off. Such a line exists if V and the closed angle between the rays are disjoint. If y is on the line of V and both
// rays leave it on one side, that line is one, wherever V lies on it: a segment that goes through a groove's edge is as
// blind in the groove as one that ends there. The leg from y stays on one side of the line of V.
//
// That last leg comes out of the dark, and is no part of a sight line. Where no valid piece crosses it, its end is as dark as its start. Where one
// does from H+ to H-, there is light behind; but while a sight line that comes into a beam stays in it, as V is on H+ of every wedge, this leg may
// leave the beam again, through a piece that it crosses from H- to H+. If one does, of all pieces that there are in the end, it is in doubt whether its end is visible.
//
// So walks are made once, and only their legs are looked at again when new wedge pieces appear (D17a).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "exact/dials.h"
#include "exact/sight/scene_query.h"
#include "reference/visibility/labels/special_position.h"
#include "reference/visibility/wedges/anticone.h"
#include "reference/visibility/wedges/contour.h"
#include "reference/visibility/wedges/wedge_set.h"

namespace clues::reference {

struct Leg {
  exact::Point3 m, p;
  std::uint32_t piece = 0;   // the surface at m
  bool front = true;         // its side that faces p
  bool from_edge = false;    // m is on an edge of the piece, and stands for the space beside it (see Walker::walk)
  bool from_corner = false;  // m is a corner of the piece, and stands for the dark space next to it (corner.h)

  bool is_sight_line() const { return !from_edge && !from_corner; }
};

struct Walk {
  // Its last leg comes out of a groove or a corner.
  bool ends_in_the_dark() const { return !legs.empty() && !legs.back().is_sight_line(); }
  // Whether the leg that is no part of a sight line, if there is one, meets number i of what was left out.
  bool runs_through(const LeftOut& left_out, std::size_t i) const;

  bool ends_at_cell = false;
  bool unresolved = false;  // never ends: the label is visible, as a counted fallback
  bool special = false;   // for want of a sight line in general position to where it starts; another start may have one
  std::vector<Leg> legs;  // from p towards the cell
};

// The side of a piece on which a point is asked for.
struct SurfaceSide {
  std::uint32_t piece = 0;
  bool front = true;
};

// What a walk starts from: a point of free space, of a surface side, or just off a contour edge.
struct Start {
  exact::Point3 p;
  std::optional<SurfaceSide> surface;
  const ContourEdge* contour =
      nullptr;  // D13a: p is inside this edge, meant just off it in H-, beside the supporting polygon
  std::optional<exact::Point3> from =
      std::nullopt;  // p is a mesh vertex, seen along the sight line from here (in int V)
};

class Walker {
 public:
  // `longest`: legs after which a walk is given up (Dials).
  explicit Walker(const exact::SceneQuery& scene, std::int64_t longest = exact::Dials::kOwn);

  // Different seeds use different sight lines; the label must not depend on the seed (D14). `least`: legs along sight lines before the walk may end with one that comes out of the dark.
  // Deterministic.
  Walk walk(const Start& start, std::uint64_t seed, std::size_t least = 0) const;

  // Whether the walk's start is visible by the wedge pieces from index `first` on, as far as sight lines tell; degenerate: walk again with another seed.
  Meets visible(const Start& start, const Walk& walk, const WedgeSet& wedges, std::size_t first) const;
  // The same by a last leg that comes out of the dark (see above).
  Meets visible_by_last_leg(const Start& start, const Walk& walk, const WedgeSet& wedges, std::size_t first) const;
  // Whether that is in doubt when `wedges` are complete: a piece may cross that leg the other way. False without such a leg.
  bool last_leg_is_in_doubt(const Start& start, const Walk& walk, const WedgeSet& wedges) const;

  struct Label {
    bool visible = false;
    bool fallback = false;  // visible only because the walk was unresolved, or says nothing (LeftOut), or is in doubt
  };
  // Walks with one seed after another until a walk is in general position with all the wedges.
  Label label(const Start& start, const WedgeSet& wedges, const LeftOut& left_out, std::uint64_t seed) const;

 private:
  // Whether a piece from index `first` on crosses the way from m to p, the leg or its reverse, from H+ to H-.
  Meets crossed(const Start& start, const Walk& walk, const Leg& leg, const exact::Point3& m, const exact::Point3& p,
                const WedgeSet& wedges, std::size_t first) const;
  using Good = std::function<bool(const exact::Point3&)>;
  // A point v of int V near `anchor` (or anywhere) that satisfies the predicate; it must hold near the anchor.
  exact::Point3 choose(std::uint64_t seed, const std::optional<exact::Point3>& anchor, const Good& good) const;
  // For a p in a plane with V, on the border of what of V is on the positive sides of the planes: next to which sight lines to p may be in general
  // position. `special`: they are nowhere.
  std::optional<exact::Point3> generic_viewpoint(const std::vector<exact::Plane3>& sides, const exact::Point3& p,
                                                 bool off_planes, bool& special) const;
  // Of a flat cell or a segment, what of int V sees p, a point of the surface, if it is near enough: the foot of p, and, where that is behind the surface or may be, a point in front of it as far from p.
  std::vector<exact::Point3> beneath(const exact::Point3& p, const SurfaceSide& on) const;
  // A multiple of the distance of x from the piece's plane, positive on the given side.
  exact::FT height(const SurfaceSide& on, const exact::Point3& x) const;
  // Calls visit(s, x) for each edge or diagonal of V that leaves the open side at x, a point of its plane, from the vertex
  // s; until it says true.
  using Leaving = std::function<bool(const exact::Point3&, const exact::Point3&)>;
  void leaves(const SurfaceSide& side, const Leaving& visit) const;
  // A point of V strictly on the given side of the piece's plane, and, if `also` is given, on that side of that plane too; none when V has no such point.
  std::optional<exact::Point3> anchor_beyond(const SurfaceSide& side, const SurfaceSide* also) const;

  // ---- what does not end (grooves.cpp)

  // Points of the closed V in both closed half spaces, for two walls that no point of V is strictly in front of at once: what is extreme of V there, and more.
  // None if V keeps away.
  std::vector<exact::Point3> ends_of_groove(const SurfaceSide& one, const SurfaceSide& two) const;
  // v in int V near one of these ends, strictly in front of `on`, such that the sight line to p does not come through the wall `before` last; none was
  // found: nullopt.
  std::optional<exact::Point3> along_groove(const exact::Point3& p, const SurfaceSide& on, const SurfaceSide& before,
                                            const std::vector<exact::Point3>& ends) const;
  // Whether the piece lies in the plane of the side `in` and in front of `before`, at least in part.
  bool is_wall(std::uint32_t piece, const SurfaceSide& in, const SurfaceSide& before) const;
  // Whether pieces of both walls of a groove meet in the edge.
  bool carries_both(const exact::Edge& e, const SurfaceSide& one, const SurfaceSide& two) const;
  // A wall of a groove is all of a flat surface, which others may cut into many pieces.
  struct Wall {
    std::vector<std::uint32_t> pieces;
    std::vector<std::uint32_t> edges;  // at which the other wall stands on it
  };
  Wall wall_of(const SurfaceSide& one, const SurfaceSide& other) const;
  // Whether the wall's pieces at a point of the edge fill the angle between two edges on one line, on the side in front of the other wall. Where they leave a notch, a viewer next to
  // the line sees along the groove through it, however near the edge.
  bool is_whole_at(std::uint32_t point, std::uint32_t from, std::uint32_t to, const SurfaceSide& wall,
                   const SurfaceSide& other) const;
  // Whether V and the closed groove between two walls that meet in this edge, which q is in, share nothing but points of the edge, and of
  // the edges that carry both walls on along its line without a gap, and of that line beyond ends that are closed.
  bool is_dark_over(std::uint32_t edge, const SurfaceSide& one, const SurfaceSide& two, const exact::Point3& q,
                    const std::vector<exact::Point3>& shared) const;
  // Whether the plane of a flat cell divides the two. No sight line crosses it, and labels on its two sides have nothing to
  // do with each other (T10): a leg that is not part of a sight line may not cross it either.
  bool divided_by_cell(const exact::Point3& x, const exact::Point3& y) const;
  // The last leg of a walk that runs into a dark corner for ever.
  std::optional<Leg> corner_leg(const Walk& walk) const;
  // Where it is dark because two of the walls there are those of a dark groove, which the others close.
  std::optional<Leg> leg_from_edge_at_corner(const Walk& walk) const;
  // The last leg of a walk that runs into the groove between two pieces for ever. `shared`: what V and the closed groove share (ends_of_groove).
  std::optional<Leg> groove_leg(const Walk& walk, const std::vector<exact::Point3>& shared) const;
  // Its leg from the edge to q, a point in front of both walls; or, if the cell is a segment, the one from the tip of the
  // groove in the plane through the cell and q.
  std::optional<Leg> leg_from_edge(const SurfaceSide& wall, const SurfaceSide& other, const exact::Point3& q,
                                   const std::vector<exact::Point3>& shared) const;
  // `apart`: they share nothing.
  std::optional<Leg> leg_in_slice(const SurfaceSide& wall, const SurfaceSide& other, const exact::Point3& q,
                                  bool apart) const;
  // A piece of the wall that holds y, a point of its plane, and what comes next in direction d.
  std::optional<std::uint32_t> piece_from(const exact::Point3& y, const exact::Vector3& d, const SurfaceSide& wall,
                                          const SurfaceSide& other) const;

  exact::Point3 last_crossing(const exact::Point3& v, const exact::Point3& p, const exact::Hit& hit,
                              const Good& good) const;
  const exact::SceneQuery* scene_;
  std::int64_t longest_;
  std::vector<scene::Point> corners_;             // of V, about
  std::optional<SpecialPosition> in_cell_plane_;  // of a flat cell
};

}  // namespace clues::reference
