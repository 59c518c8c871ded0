// The scenes of the tests of backprojection: a plate that hides from its edge, the contour segment, what lies in the strip that is the cell.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "exact/complex/complex.h"
#include "reference/visibility/refinement/backprojection.h"
#include "support.h"

namespace clues::test {

std::uint32_t edge_between(const exact::Complex& complex, const exact::Point3& a, const exact::Point3& b);

// The strip x = 0, -4 <= y <= 0 as cell; a plate that ends in the edge x = 10, y = 0.
extern const exact::ConvexCell kStrip;
SceneBuilder plate_below();
reference::ContourSegment segment_at_ten(const exact::Complex& complex);
// For questions in which only the ends matter.
reference::ContourSegment segment(const exact::Point3& lo, const exact::Point3& hi);

exact::FT lowest_y(const std::vector<exact::Point3>& points);
exact::FT highest_y(const std::vector<exact::Point3>& points);

}  // namespace clues::test
