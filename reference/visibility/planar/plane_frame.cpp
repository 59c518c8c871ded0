#include "reference/visibility/planar/plane_frame.h"

namespace clues::reference {

using exact::FT;
using exact::Point2;
using exact::Point3;

Point3 lifted_onto(const exact::Plane3& plane, const Point2& q) {
  const int axis = exact::dominant_axis(plane.orthogonal_vector());
  const FT n[3] = {plane.a(), plane.b(), plane.c()};
  const bool flip = CGAL::is_negative(n[axis]);
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  FT x[3];
  x[u] = flip ? q.y() : q.x();
  x[w] = flip ? q.x() : q.y();
  x[axis] = -(n[u] * x[u] + n[w] * x[w] + plane.d()) / n[axis];
  return exact::collapsed(Point3(x[0], x[1], x[2]));
}

}  // namespace clues::reference
