// Whether two sets of polygons are one set of points, decided by their borders alone: no arrangement, no overlay, no
// code of those who made them. Plain rationals.
//
// A border is a sum of directed segments; along every line it is a step function, and two borders are equal when all of
// these are. Let w(p) be the winding number of a border around p. Equal borders have equal winding numbers. Of polygons
// whose outer rings turn counter-clockwise and whose holes turn clockwise, w(p) is the number of polygons that p lies
// in. So if positively oriented triangles have together the border of one triangle T, every point of T lies in exactly
// one of them, but for their edges, and no other point in any.
#pragma once

#include <map>
#include <utility>

#include "validate/windows/rational.h"

namespace clues::validate {

class BoundaryChain {
 public:
  // The segment from a to b, so many times. O(log n).
  void add(const RVector& a, const RVector& b, int times);
  // A closed ring. O(n log n).
  template <class Ring>
  void add_ring(const Ring& ring, int times) {
    for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()], times);
  }

  bool empty() const { return steps_.empty(); }

 private:
  using Line = std::pair<IVector, RVector>;  // its direction, shortest and towards larger coordinates; its moment
  // What changes at each point on the way along the line; lines and points where nothing does are left out.
  std::map<Line, std::map<RVector, int>> steps_;
};

}  // namespace clues::validate
