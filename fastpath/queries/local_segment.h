// Stage 1 of the segment queries: a segment in floats, in the local frame, with bounds on how far that is from the segment meant.
#pragma once

#include <array>
#include <cstddef>

#include "fastpath/queries/local_frame.h"

namespace clues::fastpath {

struct LocalSegment {
  // The part of the segment that can meet the scene runs from start to start + along, up to `position_error` in each coordinate: the point at
  // s in [0,1] of the float segment is that near to the point at begin + s (end - begin) of the exact one.
  std::array<float, 3> start{}, along{};
  double begin = 0, end = 1;

  // Boxes (box_lanes.h): s runs from (near side - near_origin) * inverse to (far side - far_origin) * inverse.
  std::array<float, 3> near_origin{}, far_origin{}, inverse{};
  std::array<bool, 3> forward{};  // along >= 0: the near side is the low one

  // Triangles (triangle_block.h): bounds on the errors of U and V: edge_error E; of W: E (sum_error + sum_error_2 E); of T and
  // T - den: plane_error E^2.
  float edge_error = 0, sum_error = 0, sum_error_2 = 0, plane_error = 0;
};

enum class Reach : unsigned char { misses, may_meet };

// Finite end points, else scene::Error. `misses`: the segment is outside the scene's box. A segment that is too far out for floats comes back as
// one that may meet every box and decides no triangle.
Reach make_local(const LocalFrame& frame, const Segment& s, LocalSegment& out);

// The part of make_local that derives bounds from errors, for tests: exact coordinates of start and along are within start_error and
// along_error of the floats, whose sizes are at most start_size and along_size (exact ones too).
struct LocalErrors {
  double start_error = 0, along_error = 0, start_size = 0, along_size = 0;
};
void set_triangle_bounds(const LocalErrors& e, LocalSegment& out);

}  // namespace clues::fastpath
