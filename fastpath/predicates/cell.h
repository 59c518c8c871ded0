// D2, D3: the view cell as the segment queries need it. What a triangle has in the inside of a solid cell does not
// occlude; where the cell is flat, a segment or a point, everything does.
#pragma once

#include <memory>
#include <vector>

#include "fastpath/predicates/filter.h"

namespace clues::exact {
class ConvexCell;
}

namespace clues::fastpath {

struct ExactCell;  // rational half spaces; exact_segment.cpp

class Cell {
 public:
  // The convex hull of finite points; at least one. Throws scene::Error.
  explicit Cell(const std::vector<Point>& points);
  // A cell whose vertices are doubles. Throws scene::Error.
  explicit Cell(const exact::ConvexCell& hull);

  const std::vector<Point>& vertices() const { return vertices_; }  // extreme points only

  // Two ranges of parameters on the segment: the inside of a solid cell is met within `outer` only, and all of `inner` is
  // in it. Empty when low > high, as both are for other cells.
  struct Span {
    Range outer{0, 1}, inner{1, 0};
  };
  Span span_of(const Segment& s) const;
  // True only of points strictly inside a solid cell.
  bool surely_holds_inside(const Point& p) const;

  const ExactCell& exact() const { return *exact_; }  // of a solid cell

 private:
  int dimension_ = 0;
  std::vector<Point> vertices_;
  std::vector<Corners> facets_;  // dimension 3: three corners of each facet, counter-clockwise seen from outside
  std::shared_ptr<const ExactCell> exact_;
};

}  // namespace clues::fastpath
