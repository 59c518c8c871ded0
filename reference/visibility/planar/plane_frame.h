// Two coordinates in a plane, so that "counter-clockwise about the plane's normal" is "counter-clockwise" of the flat points.
#pragma once

#include "exact/complex/complex_internal.h"
#include "exact/kernel.h"

namespace clues::reference {

class PlaneFrame {
 public:
  // In units of `unit`, a power of two.
  explicit PlaneFrame(const exact::Plane3& plane, double unit = 1)
      : axis_(exact::dominant_axis(plane.orthogonal_vector())),
        flip_(CGAL::is_negative(plane.orthogonal_vector()[axis_])),
        unit_(unit) {}

  exact::Point2 operator()(const exact::Point3& p) const {
    const exact::Point2 q = exact::drop_axis(p, axis_, unit_);
    return flip_ ? exact::Point2(q.y(), q.x()) : q;
  }
  // The point of this plane, which is that of the frame, that is laid there.
  exact::Point3 lifted(const exact::Plane3& plane, const exact::Point2& q) const {
    return exact::lift_axis(plane, flip_ ? exact::Point2(q.y(), q.x()) : q, axis_, unit_);
  }

 private:
  int axis_;
  bool flip_;
  double unit_;
};

}  // namespace clues::reference
