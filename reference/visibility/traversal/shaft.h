// The shaft between a triangle and the cell: their convex hull. Everything that decides the labels of the triangle lies in it: a sight line, a leg of
// a walk and the segment from a wedge point by its source to V all stay inside.
#pragma once

#include <array>

#include "exact/convex_cell.h"
#include "exact/kernel.h"
#include "exact/point_occlusion.h"

namespace clues::reference {

class Shaft {
 public:
  Shaft(const exact::TriangleCorners& triangle, const exact::ConvexCell& cell);

  // Whether the triangle reaches into the open shaft. Touching it does not count; a flat shaft (triangle and V in one plane) has no inside.
  bool is_entered_by(const exact::TriangleCorners& triangle) const;
  // Whether the triangle lies in the closed shaft.
  bool holds(const exact::TriangleCorners& triangle) const;
  const CGAL::Bbox_3& box() const { return box_; }

 private:
  exact::ConvexCell hull_;
  CGAL::Bbox_3 box_;
};

}  // namespace clues::reference
