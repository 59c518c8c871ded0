// Whether a whole convex set is hidden. This is decided here and nowhere else: of boxes and triangles for the closure, of sides (D15), of regions; refinement asks by way of
// the maps of its parts. A set is called hidden only if one of its points is (D14), no valid wedge piece touches it, and it is surely outside the anti-cone A(x) (D8) of
// every apex x whose wedges a limit of D17 left out. All else is visible, or counted as such.
//
// Theorem. Let W be the valid pieces that were built and X the apexes whose wedges were left out. Let M be convex (or the inside of a triangle, and what is right beside it), let no
// surface that light meets or that is edge-on to all of a flat V, and no piece of W cut M, and let M be disjoint from the closed A(x) of every x in X. If the walk from one point of M calls it hidden, no point of M is in Omega.
// Proof. A(x) is x and a convex cone; so y in A(x) gives y - x + (cone of y - V) in the cone of x - V: A(y) lies in A(x), and the same holds for the closed ones.
// (1) What a wedge with an apex or on an edge at y could show lies in the closed A(y): a leg of a walk that crosses the wedge at q runs on in A(q), so does every later leg, whose
// m is on the one before; and q is in the closed A(y). So a walk from a point outside is right as far as it follows sight lines. Where it does not (from the place beside m to p, a rounding
// off the line; from the bottom of a groove, or a corner) no piece of W is in the way, but a missing one may be: a walk counts only if the ways there keep out of every A(x).
// (2) Whatever is in W of the unlimited search and not in W comes from X: its source y, a vertex or a part of an edge, or one of its probes, was lit by a wedge of X, or of another such source.
// By (1), going back, y is in the closed A(x) for some x in X, and so is all that its wedges could show. That is where the walks by W can be wrong, and only there.
// So the point of M that was asked is hidden. Were another point of M in Omega, a missing wedge would cross M between the two; it lies in a closed A(x), and M keeps out of it.
//
// The point that is asked may be beside M, with nothing between: then M stands for the hull of both. (Each of the two outside of A(x) is not enough: A(x) may lie between
// them, found/place-across-a-csv.obj.)
//
// (3) A source is asked at a place beside it. If a missing wedge passes between the two, it may count as hidden though it is lit by W alone: then its own wedges are missing, and
// need not be in any closed A(x). Or it counts as lit though it is dark, and a sector that would be there without its false light is missing. That is no concern where the source as a whole is in one A(x), nor where the
// way from its point y to the place is outside of all of them, and so is the part of the edge from y to both sides until it enters one, and stays there until the end: the space beside
// has one label, as M; and its walk counts, as above. Any other source is counted among X itself (search/doubtful_sources.h), a part of an edge with a convex set that holds the A(y) of all its
// points, until none is left.
//
// One point of M outside A(x) says nothing about the rest of M: that took triangle 2 from tests/differential/limit-hides-a-tip.obj. The test is against the facets of A(x): M is outside if all its corners are
// strictly in front of one, in intervals. (Where A(x) lies in a plane, as for x in the plane of a flat cell, that plane is all that is asked.)
#pragma once

#include <array>
#include <atomic>
#include <span>
#include <vector>

#include "fastpath/visibility/labels/left_out.h"
#include "fastpath/visibility/labels/set_label.h"
#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/points/box.h"

namespace clues::fastpath {

class OneLabel {
 public:
  // Keeps references; `pieces` are complete. Needs RoundedUp in scope, here and below.
  OneLabel(const Walker& walker, const PieceSet& pieces, const LeftOut& left_out);

  // Of a closed box that no surface touches which light meets, or which is edge-on to V (closure/darkness.h, Dividers). So below: "such surfaces" are these.
  SetLabel of_box(const Box& box) const;
  // Of the inside of a convex polygon that no such surface meets, asked at the middle of `about`: a box that holds a point of the inside and that no such surface touches.
  SetLabel of_inside(std::span<const ExactPoint> polygon, const Box& about) const;
  // Of what is right beside the inside, on the side on which the middle of `about` is. Surfaces and pieces in the triangle's own plane do not cut that; other surfaces that light meets
  // must not meet the inside, nor touch the box.
  SetLabel of_beside(const Corners& triangle, const Box& about) const;
  // Of the hull of what the boxes enclose, which neither surface nor piece cuts, as the caller knows, at a point of it, or beside it with nothing between.
  SetLabel of_uncut(std::span<const IntervalBox> hull, const ExactPoint& p) const;

  // False only if no valid piece meets the closed box (the closed triangle).
  bool piece_may_touch(const IntervalBox& box) const;
  bool piece_may_touch(const Corners& triangle) const;

  // How often something was called visible because it was not known. Any number of threads may ask and be asked.
  std::uint64_t unresolved() const { return unresolved_; }

 private:
  bool piece_in_plane(std::size_t piece, std::span<const ExactPoint> corners) const;
  // Whether a piece that passes the test may touch the closed polygon with corners in these boxes.
  template <class Test>
  bool any_may_touch(std::span<const IntervalBox> polygon, const Test& test) const;
  // Whether one that counts has a point inside the polygon, or may.
  template <class Counts>
  bool any_meets_inside(std::span<const ExactPoint> polygon, const Counts& counts) const;

  const Walker& walker_;
  const PieceSet& pieces_;
  const LeftOut& left_out_;
  mutable std::atomic<std::uint64_t> unresolved_{0};
};

}  // namespace clues::fastpath
