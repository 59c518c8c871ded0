// FIG. 20B: at an inside corner of a silhouette the gap between two wedges is closed by swept wedges (SE-MV), or by their planes, extended until they intersect.
//
// Swept wedges are exact (D12), planes are fewer. Between the chain of swept wedges and the two planes lies a cone at the corner: what the chain hides in it, the planes do
// not. Letting that part of a map become visible is conservative, because what is hidden only shrinks (D7), and nothing else of the map depends on it: its wedges and labels are those of the chain.
//
// Hazard B-25. The published measure of what is given up, the smallest angle between the line of intersection and a ray of the chain, is nothing if the chain begins near the line
// and bulges far from it; here it is the largest. The line has two directions: the one that continues both wedges beyond the corner counts. There is
// none where the planes are parallel, where a wedge would have to be cut instead of extended, or where three wedges meet: such corners stay swept.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/kernel.h"
#include "reference/visibility/map/visibility_map.h"
#include "reference/visibility/planar/flat_set.h"

namespace clues::reference {

struct InsideCorner {
  exact::Point3 x;      // a mesh vertex or a CSV
  exact::Vector3 line;  // along the intersection of the planes of the two wedges
  struct Swept {
    exact::Plane3 plane;
    exact::Vector3 ray0, ray1;
  };
  std::vector<Swept> chain;  // at least one; neighbours have a ray in common

  // Whether no ray of the chain is farther than this from the line. The cosine is a double; compared with it exactly.
  bool within(double degrees) const;
};

// Those whose planes can stand in for the chain, by position. O(c w) for c corners and w wedges.
std::vector<InsideCorner> inside_corners(const VisibilityMap& map);

// What stays hidden of a side of a piece when the corners' planes stand in for their chains. A corner counts where a boundary on this side runs along its chain, and only if that
// saves a segment. `taken` has an entry for each corner; those that were used are set.
FlatSet hidden_by_planes(const FlatSet& hidden, const exact::Complex& complex, std::uint32_t piece,
                         const std::vector<const DmSegment*>& boundary, const std::vector<InsideCorner>& corners,
                         std::vector<char>& taken);

}  // namespace clues::reference
