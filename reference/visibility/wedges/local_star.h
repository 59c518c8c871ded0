// The scene around one point x, as seen on a small sphere: every incident piece is an arc of a great circle, and the free space
// around x falls into faces between the arcs. A sight line that passes x close by runs on the sphere along the shorter great
// circle arc from where it comes from to where it goes. Used to decide on which sides of the surface at x a wedge with apex x exists (D12, D13).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "exact/kernel.h"

namespace clues::reference {

// A direction just beside another: limit, moved a little towards aside, and by much less towards off.
struct Beside {
  exact::Vector3 limit, aside, off;
};
// The side of the plane with this normal that it is on.
CGAL::Sign side_of(const exact::Vector3& normal, const Beside& d);

// Whether one is a positive multiple of the other.
bool same_direction(const exact::Vector3& a, const exact::Vector3& b);

class LocalStar {
 public:
  // Around mesh vertex `point`, or around x inside edge `edge`.
  static LocalStar around_vertex(const exact::Complex& complex, std::uint32_t point);
  static LocalStar around_edge_point(const exact::Complex& complex, std::uint32_t edge, const exact::Point3& x);

  // Whether arcs meet the great circle of this normal in more than one place. If not, it divides no face next to it: one gets from one way through it to another along it.
  bool meets_circle(const exact::Vector3& normal) const;
  // The same star with that circle drawn into it: arcs are cut where it crosses them, it is cut where they meet it, and what arcs cover of it is left
  // out.
  LocalStar with_circle(const exact::Vector3& normal) const;
  // Of a star with a circle, for each part of it that no arc covers: the faces on the negative and on the positive side of the normal.
  std::vector<std::pair<std::vector<int>, std::vector<int>>> across_circle() const;

  // Names the face of the sphere that contains d (not on an arc): two directions lie in one face exactly when the names are equal.
  std::vector<int> face_of(const exact::Vector3& d) const;

  // The directions in which the arcs that border this face end.
  std::vector<exact::Vector3> border_of(const std::vector<int>& face) const;

  // How many sides of arcs that end in this direction the face has: two for each sector next to it in which the face comes there.
  int sides_at(const exact::Vector3& d, const std::vector<int>& face) const;

  // Whether the great circle arc from d0 (excluded) to d1 (included) surely meets no incident piece. d0 and d1 not opposite.
  bool free_between(const exact::Vector3& d0, const exact::Vector3& d1) const;

  // The same for a direction just beside another; touching an end of an arc counts as meeting it.
  bool free_between(const Beside& d0, const exact::Vector3& d1) const;

  // Around an edge point, for d and `inner` in one face, inner in the interior of the convex cone spanned by `rays`: whether one can go from d
  // to inner by arcs that each run towards a direction inside the cone, without meeting a piece. (A point visible at d has continuations in all
  // directions of the anti-cone; so this says whether visible space at d spreads to inner.)
  bool spreads_around_edge(const Beside& d, const exact::Vector3& inner, const std::vector<exact::Vector3>& rays) const;

  // d moved towards `by`, and by much less towards `then`, so little that no piece lies between.
  exact::Vector3 nudged(const exact::Vector3& d, const exact::Vector3& by,
                        const exact::Vector3& then = CGAL::NULL_VECTOR) const;

  // Directions from x (outside the cell, or on its border) into int V such that every face that is met by the cone of V at x contains one. Such a part of
  // a face has a corner: a vertex of V, a place where the plane of a piece crosses an edge of V, or the direction of an edge at x. One for each such
  // place and each side of it.
  std::vector<exact::Vector3> into_cell(const exact::Point3& x, const exact::ConvexCell& cell) const;

  // The directions of the plane through x with this normal in which a piece crosses or touches it.
  std::vector<exact::Vector3> traces(const exact::Vector3& normal) const;

 private:
  struct Arc {
    int a, b;               // nodes
    exact::Vector3 normal;  // a x b
  };
  void finish();  // joins the two sides of arcs into faces
  int root(int side) const;
  // d's distance from the plane of each arc, in units of the arc's normal.
  std::vector<exact::FT> heights(const exact::Vector3& d) const;
  // With these heights of d0 and d1.
  bool free_between(const exact::Vector3& d0, const std::vector<exact::FT>& heights0, const exact::Vector3& d1,
                    const std::vector<exact::FT>& heights1) const;
  // nudged(), or nullopt when no step is small enough: the way runs along an arc through d.
  std::optional<exact::Vector3> nudged_if_possible(const exact::Vector3& d, const exact::Vector3& by,
                                                   const exact::Vector3& then) const;
  // The arc side first met from d on the way to a point of an arc, within that arc's component; none if the way is not clean.
  std::optional<int> side_met(const exact::Vector3& d, std::size_t aim_arc, int aim = 0) const;

  std::vector<exact::Vector3> nodes_;
  std::vector<Arc> arcs_;
  std::vector<int> face_;       // per arc side (2i: positive side of the normal, 2i+1: negative): union-find parent
  std::vector<int> component_;  // per arc: connected component of the arcs
  std::size_t circle_ = 0;      // the first arc of the circle, which are the last ones
};

}  // namespace clues::reference
