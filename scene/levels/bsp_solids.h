// Structural brushes as the file gives their planes: neither moved nor rounded, so that between two that abut there is no
// crack. Hulls (bsp_hulls.h) have some: that is fine for lists, but a sight line through one proves nothing.
#pragma once

#include <array>
#include <vector>

#include "scene/levels/bsp_file.h"
#include "scene/levels/polytope.h"

namespace clues::scene {

// The half space behind the plane.
HalfSpace half_space_of(const BspFile::Plane& plane);

class SolidBrushes {
 public:
  explicit SolidBrushes(const BspFile& level);

  // Whether the segment from v to p, a point of the drawn triangle, meets a brush of the world before p; to touch it is enough, since two
  // brushes may touch there. Compilers move drawn triangles a little into their brushes: a brush with p inside is passed over where
  // the triangle is within side_thickness of a side that v is in front of, and the segment enters the brush over the triangle, at most side_thickness away from its plane. Who looks at a drawing from
  // behind looks through the brush.
  bool block(const RationalPoint& v, const RationalPoint& p, const std::array<Point, 3>& drawn) const;

 private:
  struct Side {
    HalfSpace exact;
    Point normal;  // the same in doubles, exactly
    double distance = 0;
  };
  std::vector<std::vector<Side>> brushes_;  // the sides of each
};

}  // namespace clues::scene
