#include "fastpath/solids/exact_sections.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace clues::fastpath::solids {
namespace {

constexpr double kBriefUnit = 0x1p6, kBriefMost = 0x1p17;

bool is_brief(double x) { return std::fabs(x) < kBriefMost && x * kBriefUnit == std::nearbyint(x * kBriefUnit); }

ExactSpot with_rationals(double x, double y, mpq_class exact_x, mpq_class exact_y) {
  return {x, y,
          std::make_shared<const std::array<mpq_class, 2>>(
              std::array<mpq_class, 2>{std::move(exact_x), std::move(exact_y)})};
}

ExactSpot spot(mpq_class x, mpq_class y) {
  const double near_x = x.get_d(), near_y = y.get_d();
  if (is_brief(near_x) && is_brief(near_y) && x == near_x && y == near_y) return exact_spot(near_x, near_y);
  return with_rationals(near_x, near_y, std::move(x), std::move(y));
}

mpq_class x_of(const ExactSpot& s) { return s.exact ? (*s.exact)[0] : mpq_class(s.x); }
mpq_class y_of(const ExactSpot& s) { return s.exact ? (*s.exact)[1] : mpq_class(s.y); }

mpq_class exact_turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c) {
  const mpq_class ax = x_of(a), ay = y_of(a);
  return (x_of(b) - ax) * (y_of(c) - ay) - (y_of(b) - ay) * (x_of(c) - ax);
}

// Twice the area of abc, and how wrong that may be.
struct Turn {
  double value = 0, error = 0;
};

Turn turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  Turn t{bx * cy - by * cx, 0};
  if (!a.exact && !b.exact && !c.exact) return t;
  // Each coordinate is off by less than 2^-51 of the largest, a difference by less than 2^-49 of it; products and their difference add 2^-50 of the products.
  const double largest =
      std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y), std::fabs(c.x), std::fabs(c.y)});
  const double lengths = std::fabs(bx) + std::fabs(by) + std::fabs(cx) + std::fabs(cy);
  t.error = 0x1p-47 * largest * (lengths + 0x1p-47 * largest) + kUnderflow;
  return t;
}

}  // namespace

ExactSpot exact_spot(double x, double y) {
  if (is_brief(x) && is_brief(y)) return {x, y, nullptr};
  return with_rationals(x, y, x, y);
}

int sign_of_turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c) {
  const Turn t = turn(a, b, c);
  if (t.value > t.error) return 1;
  if (t.value < -t.error) return -1;
  return t.error == 0 ? 0 : sgn(exact_turn(a, b, c));
}

namespace {

// By one coordinate, the axis-th.
int compare(const ExactSpot& a, const ExactSpot& b, std::size_t axis) {
  const double near_a = axis == 0 ? a.x : a.y, near_b = axis == 0 ? b.x : b.y;
  if (!a.exact && !b.exact) return near_a < near_b ? -1 : near_a > near_b ? 1 : 0;
  const double error = 0x1p-50 * (std::fabs(near_a) + std::fabs(near_b)) + kUnderflow;
  if (std::fabs(near_a - near_b) > error) return near_a < near_b ? -1 : 1;
  if (a.exact && b.exact) return cmp((*a.exact)[axis], (*b.exact)[axis]);
  return a.exact ? cmp((*a.exact)[axis], mpq_class(near_b)) : cmp(mpq_class(near_a), (*b.exact)[axis]);
}

bool before(const ExactSpot& a, const ExactSpot& b) {
  const int by_x = compare(a, b, 0);
  return by_x != 0 ? by_x < 0 : compare(a, b, 1) < 0;
}

}  // namespace

ExactPolygon convex_hull(std::vector<ExactSpot> points) {
  std::sort(points.begin(), points.end(), before);
  ExactPolygon hull;
  hull_of_sorted(points, sign_of_turn, hull);
  return hull;
}

namespace {

mpq_class value_at(const SectionPlane& plane, const scene::RationalPoint& p) {
  mpq_class value = -mpq_class(plane.distance);
  for (std::size_t i = 0; i < 3; ++i) {
    if (plane.normal[i] != 0) value += mpq_class(plane.normal[i]) * p[i];
  }
  return value;
}

// On which side of the plane the solid's i-th corner is.
int side_of(const SectionPlane& plane, const Solid& solid, std::size_t corner) {
  const int rough = rough_side_of(plane.normal, plane.distance, solid.corners[corner]);
  return rough != 0 ? rough : sgn(value_at(plane, solid.exact_corner(corner)));
}

ExactSpot spot_of(const Solid& solid, std::uint32_t corner, std::size_t u, std::size_t v) {
  if (solid.exact_corners.empty()) return exact_spot(solid.corners[corner][u], solid.corners[corner][v]);
  return spot(solid.exact_corners[corner][u], solid.exact_corners[corner][v]);
}

// Where an edge crosses the plane, on different sides of which its ends are.
ExactSpot crossing(const SectionPlane& plane, const Solid& solid, const std::array<std::uint32_t, 2>& edge,
                   std::size_t u, std::size_t v) {
  const auto p = solid.exact_corner(edge[0]), q = solid.exact_corner(edge[1]);
  if (p[u] == q[u] && p[v] == q[v]) return spot_of(solid, edge[0], u, v);
  const mpq_class at_p = value_at(plane, p), at_q = value_at(plane, q), share = at_p / (at_p - at_q);
  const auto along = [&](std::size_t axis) -> mpq_class { return p[axis] + share * (q[axis] - p[axis]); };
  return spot(along(u), along(v));
}

// A point of an edge, by its share of the way along it: an end, or where the line cd crosses.
struct Cut {
  double share = 0, error = 0;
  const ExactSpot *c = nullptr, *d = nullptr;  // none: an end
};

// An edge of a polygon, or any segment. That it is on the line of another edge is told by numbers of planes, where they are known: else nearly all turns that doubles leave open would be such.
class EdgeOfUnion {
 public:
  EdgeOfUnion(const ExactSpot& a, const ExactSpot& b) : a_(a), b_(b) {}
  EdgeOfUnion(const ExactPolygon& polygon, std::size_t edge)
      : a_(polygon[edge]),
        b_(polygon[(edge + 1) % polygon.size()]),
        before_(polygon[(edge + polygon.size() - 1) % polygon.size()].plane) {}

  // The part of the edge whose outer side is in the polygon.
  void cover_by(const ExactPolygon& polygon) {
    Cut from{0, 0, nullptr, nullptr}, to{1, 0, nullptr, nullptr};
    if (clip(polygon, from, to, [this](const ExactSpot& c, const ExactSpot& d) { return !same_way(c, d); }))
      covered_.emplace_back(from, to);
  }

  bool enters_all(const std::vector<ExactPolygon>& polygons) const {
    Cut from{0, 0, nullptr, nullptr}, to{1, 0, nullptr, nullptr};
    return std::all_of(polygons.begin(), polygons.end(), [&](const ExactPolygon& polygon) {
      return clip(polygon, from, to, [](const ExactSpot&, const ExactSpot&) { return false; });
    });
  }
  // Calls add(segment) for each part that is not covered.
  template <typename Add>
  void for_rim(const Add& add) {
    std::sort(covered_.begin(), covered_.end(),
              [this](const auto& x, const auto& y) { return is_less(x.first, y.first); });
    Cut at{0, 0, nullptr, nullptr};
    for (const auto& [from, to] : covered_) {
      if (is_less(at, from)) add(ExactSegment{spot_at(at), spot_at(from)});
      if (is_less(at, to)) at = to;
    }
    const Cut end{1, 0, nullptr, nullptr};
    if (is_less(at, end)) add(ExactSegment{spot_at(at), spot_at(end)});
  }

 private:
  // Takes away what is outside of the polygon. False: no open part of the edge is left, or it lies on an edge cd and that is not allowed.
  template <typename Allowed>
  bool clip(const ExactPolygon& polygon, Cut& from, Cut& to, const Allowed& on_edge) const {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const ExactSpot &c = polygon[i], &d = polygon[(i + 1) % polygon.size()];
      const auto side_of = [&](const ExactSpot& spot, std::int32_t plane_before) {
        const bool on_line = c.plane >= 0 && (c.plane == plane_before || c.plane == spot.plane);
        return on_line ? 0 : sign_of_turn(c, d, spot);
      };
      const int at_a = side_of(a_, before_), at_b = side_of(b_, a_.plane);
      if (at_a == 0 && at_b == 0) {
        if (!on_edge(c, d)) return false;
      } else if (at_a <= 0 && at_b <= 0) {
        return false;
      } else if (at_a < 0) {
        const Cut cut = cut_by(c, d);
        if (is_less(from, cut)) from = cut;
      } else if (at_b < 0) {
        const Cut cut = cut_by(c, d);
        if (is_less(cut, to)) to = cut;
      }
    }
    return is_less(from, to);
  }

  // Of lines that are the same.
  bool same_way(const ExactSpot& c, const ExactSpot& d) const { return before(a_, b_) == before(c, d); }

  Cut cut_by(const ExactSpot& c, const ExactSpot& d) const {
    const Turn at_a = turn(c, d, a_), at_b = turn(c, d, b_);
    const double across = at_a.value - at_b.value, error = at_a.error + at_b.error;
    if (std::fabs(across) <= 2 * error || across == 0) return {0.5, 1, &c, &d};
    const double share = std::clamp(at_a.value / across, 0.0, 1.0);
    return {share, 4 * error / std::fabs(across) + 0x1p-50, &c, &d};
  }

  mpq_class exact_share(const Cut& cut) const {
    if (cut.c == nullptr) return cut.share;
    const mpq_class at_a = exact_turn(*cut.c, *cut.d, a_);
    return at_a / (at_a - exact_turn(*cut.c, *cut.d, b_));
  }

  bool is_less(const Cut& x, const Cut& y) const {
    if (std::fabs(x.share - y.share) > x.error + y.error) return x.share < y.share;
    if (x.c == nullptr ? y.c == nullptr : y.c != nullptr && x.c->plane >= 0 && x.c->plane == y.c->plane) return false;
    return exact_share(x) < exact_share(y);
  }

  ExactSpot spot_at(const Cut& cut) const {
    if (cut.c == nullptr) return cut.share == 0 ? a_ : b_;
    const mpq_class share = exact_share(cut), ax = x_of(a_), ay = y_of(a_);
    return spot(ax + share * (x_of(b_) - ax), ay + share * (y_of(b_) - ay));
  }

  const ExactSpot &a_, &b_;
  std::int32_t before_ = -1;  // the plane of the edge before
  std::vector<std::pair<Cut, Cut>> covered_;
};

// The number of a side in whose plane two corners of a section are, but not a third one: that side is not in the plane of the section. -1 where none is found.
std::int32_t side_with(const Solid& solid, const ExactSpot& a, const ExactSpot& b, const ExactSpot& third) {
  for (std::size_t i = 0; i < solid.on_side.size(); ++i) {
    const auto& on = solid.on_side[i];
    const auto has = [&](const ExactSpot& spot) {
      return std::all_of(spot.between.begin(), spot.between.end(),
                         [&](std::uint32_t corner) { return std::binary_search(on.begin(), on.end(), corner); });
    };
    if (has(a) && has(b) && !has(third)) return static_cast<std::int32_t>(i);
  }
  return -1;
}

bool touch_within(const Rectangle& a, const Rectangle& b, double slack) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (b.low[i] > a.high[i] + slack || a.low[i] > b.high[i] + slack) return false;
  }
  return true;
}

}  // namespace

Rectangle rectangle_around(std::span<const ExactSpot> spots) {
  Rectangle out{{spots[0].x, spots[0].y}, {spots[0].x, spots[0].y}};
  for (const ExactSpot& s : spots) out = hull_of(out, {{s.x, s.y}, {s.x, s.y}});
  return out;
}

std::optional<ExactPolygon> section_of(const Solid& solid, const SectionPlane& plane, std::size_t dropped,
                                       Cutting cutting) {
  const std::size_t u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  std::vector<int> sides;
  bool below = false, above = false;
  for (std::size_t i = 0; i < solid.corners.size(); ++i) {
    sides.push_back(side_of(plane, solid, i));
    below = below || sides.back() < 0;
    above = above || sides.back() > 0;
  }
  if (!above || (!below && cutting == Cutting::across)) return std::nullopt;
  std::vector<ExactSpot> spots;
  const auto add = [&](ExactSpot spot, const std::array<std::uint32_t, 2>& between) {
    spot.between = between;
    spots.push_back(std::move(spot));
  };
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == 0) add(spot_of(solid, i, u, v), {i, i});
  }
  for (const auto& edge : solid.edges) {
    if (sides[edge[0]] * sides[edge[1]] < 0) add(crossing(plane, solid, edge, u, v), edge);
  }
  if (spots.size() < 3) return std::nullopt;
  ExactPolygon hull = convex_hull(std::move(spots));
  if (hull.size() < 3) return std::nullopt;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    hull[k].side = side_with(solid, hull[k], hull[(k + 1) % hull.size()], hull[(k + 2) % hull.size()]);
    if (hull[k].side >= 0) hull[k].plane = solid.sides[static_cast<std::size_t>(hull[k].side)].plane;
  }
  return hull;
}

std::vector<RimPart> rim_of_union(const std::vector<ExactPolygon>& polygons) {
  std::vector<Rectangle> boxes;
  for (const auto& polygon : polygons) boxes.push_back(rectangle_around(polygon));
  std::vector<RimPart> rim;
  std::vector<const ExactPolygon*> beside;
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    // Coordinates are rounded, so boxes may seem to miss each other by two roundings where they touch.
    const Rectangle& mine = boxes[i];
    const double slack = 0x1p-50 * std::max({std::fabs(mine.low[0]), std::fabs(mine.low[1]), std::fabs(mine.high[0]),
                                             std::fabs(mine.high[1])});
    beside.clear();
    for (std::uint32_t j = 0; j < polygons.size(); ++j) {
      const Rectangle& other = boxes[j];
      if (j != i && touch_within(mine, other, slack)) beside.push_back(&polygons[j]);
    }
    for (std::uint32_t k = 0; k < polygons[i].size(); ++k) {
      EdgeOfUnion edge(polygons[i], k);
      for (const auto* other : beside) edge.cover_by(*other);
      edge.for_rim([&](ExactSegment segment) { rim.push_back({std::move(segment), i, k}); });
    }
  }
  return rim;
}

bool enters_interior(const ExactSegment& segment, const std::vector<ExactPolygon>& polygons) {
  return EdgeOfUnion(segment[0], segment[1]).enters_all(polygons);
}

}  // namespace clues::fastpath::solids
