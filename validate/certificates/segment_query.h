// D14 along a segment: which parts of it can be seen from the cell? The segment is cut where it meets surfaces, valid wedge pieces and the cell; between two cuts
// the first-order label is constant, so one point decides a whole part: hidden (T1), or in Omega, and then that point is asked for a sight line.
#pragma once

#include <optional>
#include <vector>

#include "exact/kernel.h"
#include "validate/certificates/point_query.h"

namespace clues::validate {

enum class PartSight {
  visible,    // the point `at` is seen from v, or lies in the cell
  undecided,  // in Omega, but at `at` every sight line is blocked
  hidden,     // no point of the open part is seen
};

// The open part a + s (b - a), from < s < to. Neighbours of one sight are one part; at and v are of its first piece.
struct SegmentPart {
  exact::FT from, to;
  PartSight sight = PartSight::hidden;
  exact::Point3 at;
  std::optional<exact::Point3> v;
  bool contradiction = false;  // visible and yet not in Omega (T1)
};

// Parts in order from a to b. A part that runs in a surface counts as visible if it is on one of the sides. a and b differ and lie in the bounds of the
// query. O(wedge pieces + pieces) exact tests and one point question for each cut.
std::vector<SegmentPart> ask_segment(const PointQuery& query, const reference::Omega& omega, const exact::Point3& a,
                                     const exact::Point3& b);

}  // namespace clues::validate
