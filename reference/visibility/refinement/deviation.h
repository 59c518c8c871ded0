// FIG. 28, the gate: how far can the wedge of a segment move at all? From its supporting plane, which is the first-order wedge's, to the separating plane, which touches V on
// the other side; no V(s) turns it further. What an adjustment can take away lies between the two, behind the edge. Its area is what counts: an angle says nothing
// of what stands there, and the tolerance that the user gives is an area too.
#pragma once

#include <array>
#include <vector>

#include "reference/visibility/refinement/backprojection.h"
#include "reference/visibility/refinement/bounds.h"

namespace clues::reference {

// The plane through the segment that has all of V ahead of the wedge's own plane behind it: where the adjusted wedge would be if V(s) were a single point,
// as far away as it can be.
exact::Plane3 separating_plane(const ContourSegment& segment, const exact::ConvexCell& cell);

// Flat pieces of space, by their corners in doubles. Estimates: they choose what is done first and what is left out, never a label.
class DoubtfulArea {
 public:
  // What is in `seen`, and so far neither known to be visible nor known to be hidden, on the wanted sides.
  DoubtfulArea(const Bounds& bounds, const SideSets& seen, const std::vector<bool>& wanted);

  // The part of it that a wedge hides in the one plane and not in the other, both through its segment and oriented as adjusted_plane() does.
  double between(const exact::Plane3& first_order, const exact::Plane3& adjusted) const;

 private:
  using Corner = std::array<double, 3>;
  struct Ring {
    std::vector<Corner> corners;
    bool hole = false;
  };
  std::vector<Ring> rings_;
};

}  // namespace clues::reference
