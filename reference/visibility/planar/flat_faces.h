// Faces of a flat arrangement as rings of corners (outer boundary first, counter-clockwise, then holes, clockwise), and the frame that carries them
// between a piece of the complex and the plane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact/complex/complex.h"
#include "exact/kernel.h"
#include "reference/visibility/planar/plane_frame.h"

namespace clues::reference {

using Ring2 = std::vector<exact::Point2>;

// Twice the signed area of a ring.
exact::FT twice_area(const Ring2& ring);

// Without antennas: an edge into a face is walked twice and bounds nothing.
Ring2 without_spurs(Ring2 ring);

// Whether segment pq lies along the outline of the triangle, if it has no point outside.
bool on_outline(const exact::Kernel::Triangle_2& triangle, const exact::Point2& p, const exact::Point2& q);

// Whether p, on no edge, is inside by the even-odd rule. Rings may touch themselves and each other; an edge walked twice counts for nothing.
bool inside(const std::vector<Ring2>& rings, const exact::Point2& p);

// A point inside the face: of a triangle of its constrained triangulation, which one depends on `which`.
exact::Point2 inner_point(const std::vector<Ring2>& rings, std::size_t which);

// A piece of the complex, or another triangle, laid flat.
class TriangleFrame {
 public:
  TriangleFrame(const exact::Complex& complex, std::uint32_t piece);
  // Not without area.
  explicit TriangleFrame(const std::array<exact::Point3, 3>& corners);
  const PlaneFrame& frame() const { return frame_; }
  const std::array<exact::Point3, 3>& corners() const { return corners_; }
  const exact::Kernel::Triangle_2& flat() const { return flat_; }
  Ring2 outline() const { return {flat_[0], flat_[1], flat_[2]}; }  // of flat()
  exact::FT twice_area() const { return reference::twice_area(outline()); }
  // The point of the piece's plane that is laid there. Collapsed.
  exact::Point3 lift(const exact::Point2& q) const { return frame_.lifted(plane_, q); }

 private:
  exact::Plane3 plane_;
  PlaneFrame frame_;
  std::array<exact::Point3, 3> corners_;
  exact::Kernel::Triangle_2 flat_;
};

}  // namespace clues::reference
