// A view cell cut by a plane (D21): the parts of V on its two sides, as exact cells of V's own dimension.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "exact/cell/convex_cell.h"

namespace clues::exact {

// The closed part of the cell on that side of the plane (not `on`); none when it has no interior relative to the cell's dimension. O(vertices log vertices),
// and quadratic in the vertices on each side.
std::optional<ConvexCell> part_beside(const ConvexCell& cell, const Plane3& plane, Side side);

// The cell halved across its longest extent (of x, y, z; the first of equal ones). A point cannot be cut: it comes back alone.
std::vector<ConvexCell> halves(const ConvexCell& cell);

// Points of V from which to look for what V certainly sees: the corners and centres of its parts, after one halving of all parts after the other. Of a solid V those on
// its border are enough, as every sight line from inside leaves it there; its own centre comes first, for cells whose corners are all touched.
class Viewpoints {
 public:
  explicit Viewpoints(ConvexCell cell) : cell_(std::move(cell)), parts_{cell_} {}

  // Those for this depth of refinement, one and a half times as many halvings: by halvings, each point once in the object's life.
  std::vector<std::vector<Point3>> up_to(int depth);

 private:
  ConvexCell cell_;
  std::vector<ConvexCell> parts_;  // after the last halving
  std::vector<Point3> given_;
  int halvings_ = 0;  // whose points come next
};

}  // namespace clues::exact
