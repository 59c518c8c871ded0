// Triangles that are certainly visible: a free sight line (D5) from a point of int V, found by sampling and decided by exact segment queries. What has one needs no
// refinement; what has none is open.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/cell/convex_cell.h"
#include "fastpath/predicates/cell.h"
#include "fastpath/queries/bvh.h"
#include "fastpath/queries/segment_queries.h"
#include "fastpath/visibility/search/options.h"

namespace clues::fastpath {

class SightLines {
 public:
  // Keeps references.
  SightLines(const Bvh& bvh, const std::vector<Point>& cell, const exact::ConvexCell& exact_cell, SideMode mode)
      : bvh_(bvh), cell_(cell), exact_cell_(exact_cell), mode_(mode) {}

  // Points of int V in this part of it, in doubles; the same in every run. None where rounding leaves V.
  std::vector<Point> viewpoints(const exact::ConvexCell& part) const;

  // Which of these triangles, which do not meet the cell, a free sight line from one of `from` reaches: `tries` lines to each; the answer does not depend on ids. By all threads of
  // the current arena.
  std::vector<std::uint8_t> reach(const std::vector<std::uint32_t>& triangles, const std::vector<Point>& from,
                                  int tries) const;
  // Whether this ray, from a point of int V, reaches the triangle: it is free that far.
  bool reaches(SegmentQueries& queries, std::uint32_t triangle, const Segment& ray) const;

  const Cell& cell() const { return cell_; }
  const Bvh& bvh() const { return bvh_; }

 private:
  // From v by p, a point of the triangle but for roundings.
  bool reaches_by(SegmentQueries& queries, std::uint32_t triangle, const Point& v, Point p) const;

  const Bvh& bvh_;
  Cell cell_;
  const exact::ConvexCell& exact_cell_;
  SideMode mode_;
};

}  // namespace clues::fastpath
