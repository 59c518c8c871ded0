#include "fastpath/solids/openings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace clues::fastpath::solids {
namespace {

constexpr double kMostlyOpen = 0.5;  // of a rectangle: then it is not cut up
constexpr int kMostHalvings = 10;

ExactPolygon exactly(const Rectangle& r) {
  return {exact_spot(r.low[0], r.low[1]), exact_spot(r.high[0], r.low[1]), exact_spot(r.high[0], r.high[1]),
          exact_spot(r.low[0], r.high[1])};
}

// What of the polygon is in the rectangle, rounded.
std::vector<Spot> clipped_to(std::vector<Spot> polygon, const Rectangle& r) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    polygon = clipped(polygon, axis, r.low[axis], true);
    polygon = clipped(polygon, axis, r.high[axis], false);
  }
  return polygon;
}

bool is_inside(const ExactSpot& spot, const ExactPolygon& polygon, int least) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (sign_of_turn(polygon[i], polygon[(i + 1) % polygon.size()], spot) < least) return false;
  }
  return true;
}

// Whether their interiors have no point in common, by an edge of one.
bool are_apart(const ExactPolygon& a, const ExactPolygon& b) {
  const auto by_edge_of = [](const ExactPolygon& one, const ExactPolygon& other) {
    for (std::size_t i = 0; i < one.size(); ++i) {
      if (std::all_of(other.begin(), other.end(),
                      [&](const ExactSpot& s) { return sign_of_turn(one[i], one[(i + 1) % one.size()], s) <= 0; }))
        return true;
    }
    return false;
  };
  return by_edge_of(a, b) || by_edge_of(b, a);
}

class Opener {
 public:
  Opener(ExactPolygon facet, const std::vector<ExactPolygon>& polygons, const std::vector<RimPart>& rim,
         double smallest)
      : facet_(std::move(facet)), around_(rectangle_around(facet_)), smallest_(smallest) {
    for (const auto& s : facet_) rounded_.push_back({s.x, s.y});
    for (const auto& polygon : polygons) {
      if (touch(around_, rectangle_around(polygon))) polygons_.push_back(&polygon);
    }
    for (const auto& part : rim) {
      if (touch(around_, rectangle_around(part.segment)) && enters_interior(part.segment, {facet_}))
        rim_.push_back(&part.segment);
    }
  }

  std::vector<Rectangle> open() const { return open_in(around_, 0); }
  bool has_none_open() const { return is_filled(around_); }
  std::vector<Spot> part(const Rectangle& r) const { return clipped_to(rounded_, r); }

 private:
  bool is_filled(const Rectangle& r) const {
    const std::vector<ExactPolygon> both{facet_, exactly(r)};
    const auto rounded = clipped_to(rounded_, r);
    if (rounded.size() < 3) return are_apart(both[0], both[1]);
    const Spot middle = middle_of(rounded);
    const ExactSpot inner = exact_spot(middle[0], middle[1]);
    if (!is_inside(inner, both[0], 1) || !is_inside(inner, both[1], 1)) return are_apart(both[0], both[1]);
    return std::any_of(polygons_.begin(), polygons_.end(),
                       [&](const ExactPolygon* p) { return is_inside(inner, *p, 0); }) &&
           std::none_of(rim_.begin(), rim_.end(),
                        [&](const ExactSegment* segment) { return enters_interior(*segment, both); });
  }

  // Rectangles that have all that is open of one in their union.
  std::vector<Rectangle> open_in(const Rectangle& r, int depth) const {
    if (is_filled(r)) return {};
    const std::size_t longer = r.high[0] - r.low[0] >= r.high[1] - r.low[1] ? 0 : 1;
    if (depth == kMostHalvings || r.high[longer] - r.low[longer] < smallest_) return {r};
    const double middle = (r.low[longer] + r.high[longer]) / 2;
    Rectangle lower = r, upper = r;
    lower.high[longer] = upper.low[longer] = middle;
    auto open = open_in(lower, depth + 1);
    const auto above = open_in(upper, depth + 1);
    open.insert(open.end(), above.begin(), above.end());
    if (open.size() < 2) return open;
    Rectangle hull = open[0];
    double area = 0;
    for (const Rectangle& part : open) {
      hull = hull_of(hull, part);
      area += part.area();
    }
    if (area >= kMostlyOpen * hull.area()) return {hull};
    return open;
  }

  ExactPolygon facet_;
  Rectangle around_;
  double smallest_;
  std::vector<Spot> rounded_;
  std::vector<const ExactPolygon*> polygons_;
  std::vector<const ExactSegment*> rim_;
};

}  // namespace

FilledPlane::FilledPlane(const FacetPlane& plane, std::span<const Solid> solids)
    : plane_(plane), u_((plane.axis + 1) % 3), v_((plane.axis + 2) % 3) {
  SectionPlane section;
  section.normal[plane.axis] = plane.outside_is_above ? 1 : -1;
  section.distance = plane.outside_is_above ? plane.at : -plane.at;
  for (const Solid& solid : solids) {
    if (solid.bounds.low[plane.axis] > plane.at || solid.bounds.high[plane.axis] < plane.at) continue;
    if (auto polygon = section_of(solid, section, plane.axis, Cutting::just_above))
      polygons_.push_back(std::move(*polygon));
  }
  rim_ = rim_of_union(polygons_);
}

ExactPolygon FilledPlane::in_plane(const std::vector<Point>& polygon) const {
  std::vector<ExactSpot> spots;
  for (const Point& p : polygon) spots.push_back(exact_spot(p[u_], p[v_]));
  return convex_hull(std::move(spots));
}

bool FilledPlane::fills(const std::vector<Point>& polygon) const {
  ExactPolygon exact = in_plane(polygon);
  return exact.size() >= 3 && Opener(std::move(exact), polygons_, rim_, 0).has_none_open();
}

std::vector<Piece> FilledPlane::open_parts(const std::vector<Point>& facet, double smallest) const {
  const ExactPolygon polygon = in_plane(facet);
  if (polygon.size() < 3) return {Piece(facet)};
  const Opener opener(polygon, polygons_, rim_, smallest);
  std::vector<Piece> parts;
  for (const Rectangle& r : opener.open()) {
    auto part = opener.part(r);
    if (part.empty()) part = {r.low, {r.high[0], r.low[1]}, r.high, {r.low[0], r.high[1]}};
    const auto in_space = [&](const Spot& s) {
      Point p{};
      p[plane_.axis] = plane_.at;
      p[u_] = s[0];
      p[v_] = s[1];
      return p;
    };
    Piece& piece = parts.emplace_back();
    for (const Spot& s : part) piece.corners.push_back(in_space(s));
    piece.whole = facet;
    piece.box = {in_space(r.low), in_space(r.high)};
  }
  return parts;
}

}  // namespace clues::fastpath::solids
