// The shaft between a triangle, or a convex part of one, and the cell: their convex hull. Everything that decides the labels there lies in it: a sight line, a
// leg of a walk and the segment from a wedge point by its source to V all stay inside.
#pragma once

#include <span>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/kernel.h"

namespace clues::reference {

class Shaft {
 public:
  Shaft(std::span<const exact::Point3> corners, const exact::ConvexCell& cell);

  // Whether the polygon reaches into the open shaft. Touching it does not count; a flat shaft (polygon and V in one plane) has no inside.
  bool is_entered_by(std::span<const exact::Point3> polygon) const;
  // Whether the polygon lies in the closed shaft.
  bool holds(std::span<const exact::Point3> polygon) const;
  // What the shaft cuts a convex polygon into: the part inside last. One that does not reach into it is left whole.
  std::vector<std::vector<exact::Point3>> cut(const std::vector<exact::Point3>& polygon) const;
  const CGAL::Bbox_3& box() const { return box_; }

 private:
  exact::ConvexCell hull_;
  CGAL::Bbox_3 box_;
};

}  // namespace clues::reference
