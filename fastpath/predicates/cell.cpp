// D2, D3: the hull comes from exact/; what is kept are doubles, and rationals for the last resort.
#include "fastpath/predicates/cell.h"

#include <algorithm>
#include <cmath>

#include "exact/cell/convex_cell.h"
#include "fastpath/predicates/exact_cell.h"
#include "scene/messages/error.h"

namespace clues::fastpath {
namespace {

// The parameters at which the segment is on the inner side (negative: the facets' normals point outward) of one facet's plane.
void clip_at_facet(const Segment& s, const Corners& facet, Cell::Span& span) {
  const FilteredSign at_a = orient3d_filtered(facet[0], facet[1], facet[2], s.a);
  const FilteredSign at_b = orient3d_filtered(facet[0], facet[1], facet[2], s.b);
  const auto inside = [](const FilteredSign& x) { return x.certain && x.sign == Sign::negative; };
  const auto not_inside = [](const FilteredSign& x) { return x.certain && x.sign != Sign::negative; };
  if (inside(at_a) && inside(at_b)) return;
  if (not_inside(at_a) && not_inside(at_b)) {
    span.outer = {1, 0};
    span.inner = {1, 0};
    return;
  }
  const Range crossing =
      crossing_parameter(s, facet);  // [0,1] when unsure: it clips nothing from outer, all from inner
  if (inside(at_a)) {
    span.outer.high = std::min(span.outer.high, crossing.high);
    span.inner.high = std::min(span.inner.high, crossing.low);
  } else if (inside(at_b)) {
    span.outer.low = std::max(span.outer.low, crossing.low);
    span.inner.low = std::max(span.inner.low, crossing.high);
  } else {
    span.inner = {1, 0};
  }
}

exact::ConvexCell hull_of(const std::vector<Point>& points) {
  for (const Point& p : points) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
      throw scene::Error(scene::ErrorCode::non_finite, "a point of the view cell is not finite");
    }
  }
  return exact::ConvexCell::from_doubles(points);
}

}  // namespace

Cell::Cell(const std::vector<Point>& points) : Cell(hull_of(points)) {}

Cell::Cell(const exact::ConvexCell& hull) {
  require_float_rules();
  dimension_ = hull.dimension();
  for (const exact::Point3& p : hull.vertices()) {
    vertices_.push_back(exact::to_double_estimate(p));
    if (exact::to_exact(vertices_.back()) != p) {
      throw scene::Error(scene::ErrorCode::internal, "a vertex of the view cell is not a point of doubles");
    }
  }
  if (dimension_ < 3) return;
  std::vector<std::vector<Point>> polygons;
  for (const exact::CellFacet& facet : hull.facets()) {
    polygons.emplace_back();
    for (const int corner : facet.corners) polygons.back().push_back(vertices_[static_cast<std::size_t>(corner)]);
    facets_.push_back({polygons.back()[0], polygons.back()[1], polygons.back()[2]});
  }
  exact_ = make_exact_cell(polygons);
}

Cell::Span Cell::span_of(const Segment& s) const {
  if (dimension_ < 3) return {{1, 0}, {1, 0}};
  Span span;
  span.inner = {0, 1};
  for (const Corners& facet : facets_) clip_at_facet(s, facet, span);
  return span;
}

bool Cell::surely_holds_inside(const Point& p) const {
  return dimension_ == 3 && std::all_of(facets_.begin(), facets_.end(), [&p](const Corners& facet) {
           const FilteredSign side = orient3d_filtered(facet[0], facet[1], facet[2], p);
           return side.certain && side.sign == Sign::negative;
         });
}

}  // namespace clues::fastpath
