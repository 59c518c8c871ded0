// The triangles that may meet a segment, so that the witness checker, which asks each triangle in rationals, need not ask a whole level: those whose boxes meet
// the box of the segment, and that its line does not pass by on one side as seen along an axis. No other has a point of it, an end included.
#pragma once

#include <cstdint>

#include "exact/kernel.h"
#include "scene/mesh/mesh.h"

namespace clues::validate {

struct NearSegment {
  scene::TriangleMesh mesh;    // with all points of the scene
  std::uint32_t triangle = 0;  // the place of `kept` in it
};

// `kept` stays, wherever it is. O(n) in doubles and intervals.
NearSegment near_segment(scene::TriangleMesh mesh, std::uint32_t kept, const exact::Point3& v, const exact::Point3& p);

}  // namespace clues::validate
