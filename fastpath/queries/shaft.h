// Shafts: the convex hull of a triangle and the view cell holds every sight line between them. What does not meet it cannot hide any of the triangle
// from any point of the cell; when nothing meets it, all of the triangle is visible. Conservative: too many triangles, never too few.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fastpath/queries/bvh.h"

namespace clues::fastpath {

class Shaft {
 public:
  // The hull of finite points: triangle corners and cell vertices. The frame is that of the tree to be asked. O(n^3) for n cell vertices.
  Shaft(const LocalFrame& frame, const Corners& triangle, std::span<const Point> cell);

  // Bit i: the box of child i may meet the hull.
  unsigned may_meet_conservative(const BoxLanes& node) const;
  // Bit i: triangle i of the block may. Four triangles at once by the planes of the hull.
  unsigned may_meet_conservative(const TriangleBlock& block) const;
  // Whether the plane of a triangle leaves the hull on both sides or on itself.
  bool plane_may_meet_conservative(const Corners& triangle) const;

 private:
  // normal . x <= offset on the hull, in local coordinates. Any normal would do: offset is the largest value on the hull, rounded up.
  struct HalfSpace {
    std::array<float, 3> normal{};
    float offset = 0;
  };
  void add_half_space(const std::array<double, 3>& normal);

  std::vector<Point> points_;                 // as given
  std::vector<std::array<double, 3>> local_;  // and in the frame
  double slack_ = 0;
  std::vector<HalfSpace> half_spaces_;
};

// The triangles that may meet the hull of the triangle and the cell's vertices, without the ignored ones; ascending. Contains every
// triangle that does. O(log n + answer), as trees go.
std::vector<std::uint32_t> shaft_candidates_conservative(const Bvh& bvh, const Shaft& shaft,
                                                         std::span<const std::uint32_t> ignored = {});

// True only if no triangle with area meets the hull, apart from the ignored ones.
bool shaft_is_empty_conservative(const Bvh& bvh, const Shaft& shaft, std::span<const std::uint32_t> ignored = {});

}  // namespace clues::fastpath
