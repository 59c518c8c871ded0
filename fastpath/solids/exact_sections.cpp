#include "fastpath/solids/exact_sections.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace clues::fastpath::solids {
namespace {

constexpr double kBriefUnit = 0x1p6, kBriefMost = 0x1p17;

bool is_brief(double x) { return std::fabs(x) < kBriefMost && x * kBriefUnit == std::nearbyint(x * kBriefUnit); }

// More than this share of how large coordinates are, and doubles are of no use: rationals are made at once, and rounded.
constexpr double kMostOff = 0x1p-46;

// A number, as a double that is wrong by no more than `off`; 0: it is the number.
struct Estimate {
  double value = 0, off = 0;
  bool may_be_brief() const {
    const double nearest = std::nearbyint(value * kBriefUnit) / kBriefUnit;
    return std::fabs(nearest) < kBriefMost && std::fabs(value - nearest) <= off;
  }
};

Estimate rounded(const mpq_class& exact) {
  const double value = exact.get_d();  // cut off
  return {value, exact == value ? 0 : 0x1p-51 * std::fabs(value) + kUnderflow};
}

// At a share of the way, which is wrong by no more than that. Half of each bound would do.
Estimate between(const Estimate& from, const Estimate& to, double share, double off_share) {
  if (from.value == to.value && from.off == 0 && to.off == 0) return from;
  const double length = std::fabs(to.value - from.value), off = from.off + to.off;
  return {
      from.value + share * (to.value - from.value),
      2 * (off_share * (length + off) + off) + 0x1p-50 * (std::fabs(from.value) + std::fabs(to.value)) + kUnderflow};
}

LazyRationals::Pair exactly_between(const LazyRationals::Pair& from, const LazyRationals::Pair& to,
                                    const mpq_class& share) {
  return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

ExactSpot rounded_spot(LazyRationals::Pair exact) {
  const Estimate x = rounded(exact[0]), y = rounded(exact[1]);
  if (x.off == 0 && y.off == 0) return exact_spot(x.value, y.value);
  return {x.value, y.value, {x.off, y.off}, false, std::make_shared<const LazyRationals>(std::move(exact))};
}

// A spot that is near estimates with few enough errors, else rounded. Where it may be brief, so that all turns there are told in doubles, it is worth while to see if it is.
ExactSpot lazy_spot(const Estimate& x, const Estimate& y, double most_off, std::function<LazyRationals::Pair()> make) {
  if (!(x.off <= most_off && y.off <= most_off) || (x.may_be_brief() && y.may_be_brief())) return rounded_spot(make());
  ExactSpot s{x.value, y.value, {x.off, y.off}, false, nullptr};
  s.exact = std::make_shared<const LazyRationals>(std::move(make));
  return s;
}

mpq_class exact_turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c) {
  const auto p = a.rationals(), q = b.rationals(), r = c.rationals();
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

// Twice the area of abc, and how wrong that may be.
struct Turn {
  double value = 0, error = 0;
};

Turn turn(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  Turn t{bx * cy - by * cx, 0};
  if (a.is_brief && b.is_brief && c.is_brief) return t;
  // A difference is off by what its two spots are and a rounding of 2^-53 of it; products by that times the other factor, and with their difference they add three roundings.
  const double lengths = std::fabs(bx) + std::fabs(by) + std::fabs(cx) + std::fabs(cy);
  const auto of = [](const ExactSpot& s) { return std::max(s.off[0], s.off[1]); };
  const double off = 2 * (of(a) + of(b) + of(c)) + 0x1p-51 * lengths;
  t.error = off * (lengths + off) + kUnderflow;
  if (!std::isfinite(t.value)) return {0, std::numeric_limits<double>::infinity()};
  return t;
}

}  // namespace

const LazyRationals::Pair& LazyRationals::get() const {
  std::call_once(made_, [this] {
    if (!make_) return;
    pair_ = make_();
    make_ = nullptr;
  });
  return pair_;
}

LazyRationals::Pair ExactSpot::rationals() const {
  if (exact) return exact->get();
  return {mpq_class(x), mpq_class(y)};
}

ExactSpot exact_spot(double x, double y) { return {x, y, {0, 0}, is_brief(x) && is_brief(y), nullptr}; }

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
  const double off = a.off[axis] + b.off[axis];
  if (off == 0 || std::fabs(near_a - near_b) > 2 * off) return near_a < near_b ? -1 : near_a > near_b ? 1 : 0;
  return cmp(a.rationals()[axis], b.rationals()[axis]);
}

bool before(const ExactSpot& a, const ExactSpot& b) {
  const int by_x = compare(a, b, 0);
  return by_x != 0 ? by_x < 0 : compare(a, b, 1) < 0;
}

}  // namespace

bool are_equal(const ExactSpot& a, const ExactSpot& b) { return compare(a, b, 0) == 0 && compare(a, b, 1) == 0; }

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
  return rounded_spot({solid.exact_corners[corner][u], solid.exact_corners[corner][v]});
}

// A coordinate of a corner.
Estimate estimate_of(const Solid& solid, std::uint32_t corner, std::size_t axis) {
  return solid.exact_corners.empty() ? Estimate{solid.corners[corner][axis], 0}
                                     : rounded(solid.exact_corners[corner][axis]);
}

bool is_same_along(const Solid& solid, const std::array<std::uint32_t, 2>& edge, std::size_t axis) {
  if (solid.corners[edge[0]][axis] != solid.corners[edge[1]][axis]) return false;
  return solid.exact_corners.empty() || solid.exact_corners[edge[0]][axis] == solid.exact_corners[edge[1]][axis];
}

LazyRationals::Pair exact_crossing(const SectionPlane& plane, const Solid& solid,
                                   const std::array<std::uint32_t, 2>& edge, std::size_t u, std::size_t v) {
  const auto p = solid.exact_corner(edge[0]), q = solid.exact_corner(edge[1]);
  const mpq_class at_p = value_at(plane, p), at_q = value_at(plane, q), share = at_p / (at_p - at_q);
  return exactly_between({p[u], p[v]}, {q[u], q[v]}, share);
}

// Where an edge crosses the plane, on different sides of which its ends are.
ExactSpot crossing(const SectionPlane& plane, const Solid& solid, const std::array<std::uint32_t, 2>& edge,
                   std::size_t u, std::size_t v) {
  const bool same_u = is_same_along(solid, edge, u), same_v = is_same_along(solid, edge, v);
  if (same_u && same_v) return spot_of(solid, edge[0], u, v);
  const Point &p = solid.corners[edge[0]], &q = solid.corners[edge[1]];
  const RoughHeight at_p = rough_height(plane.normal, plane.distance, p),
                    at_q = rough_height(plane.normal, plane.distance, q);
  const double span = std::fabs(at_p.value - at_q.value), errors = at_p.error + at_q.error;
  if (!(span > 8 * errors)) return rounded_spot(exact_crossing(plane, solid, edge, u, v));
  // The share s of the way is (at_p + d) / (span + e), with d and e no larger than the errors, so the quotient of the rounded ones is off by (s * e - d) / span.
  const double share = std::clamp(std::fabs(at_p.value) / span, 0.0, 1.0), off_share = 2 * errors / span + 0x1p-50;
  const auto along = [&](std::size_t axis, bool same) {
    const Estimate from = estimate_of(solid, edge[0], axis);
    return same ? from : between(from, estimate_of(solid, edge[1], axis), share, off_share);
  };
  const double largest = std::max({std::fabs(p[u]), std::fabs(p[v]), std::fabs(q[u]), std::fabs(q[v])});
  return lazy_spot(along(u, same_u), along(v, same_v), kMostOff * largest,
                   [plane, &solid, edge, u, v] { return exact_crossing(plane, solid, edge, u, v); });
}

// A point of an edge, by its share of the way along it: an end, or where the line cd crosses.
struct Cut {
  double share = 0, error = 0;
  const ExactSpot *c = nullptr, *d = nullptr;  // none: an end
};

// Of the way from a to b, where the line cd crosses it.
mpq_class exact_share_of(const ExactSpot& a, const ExactSpot& b, const ExactSpot& c, const ExactSpot& d) {
  const mpq_class at_a = exact_turn(c, d, a);
  return at_a / (at_a - exact_turn(c, d, b));
}

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
    return exact_share_of(a_, b_, *cut.c, *cut.d);
  }

  bool is_less(const Cut& x, const Cut& y) const {
    if (std::fabs(x.share - y.share) > x.error + y.error) return x.share < y.share;
    if (x.c == nullptr ? y.c == nullptr : y.c != nullptr && x.c->plane >= 0 && x.c->plane == y.c->plane) return false;
    return exact_share(x) < exact_share(y);
  }

  ExactSpot spot_at(const Cut& cut) const {
    if (cut.c == nullptr) return cut.share == 0 ? a_ : b_;
    const double largest = std::max({std::fabs(a_.x), std::fabs(a_.y), std::fabs(b_.x), std::fabs(b_.y)});
    return lazy_spot(between({a_.x, a_.off[0]}, {b_.x, b_.off[0]}, cut.share, cut.error),
                     between({a_.y, a_.off[1]}, {b_.y, b_.off[1]}, cut.share, cut.error), kMostOff * largest,
                     [a = a_, b = b_, c = *cut.c, d = *cut.d] {
                       return exactly_between(a.rationals(), b.rationals(), exact_share_of(a, b, c, d));
                     });
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

// For each of the boxes the others that touch it, ascending: found where they begin one after the other along the first axis.
std::vector<std::vector<std::uint32_t>> touching_pairs(const std::vector<Rectangle>& boxes) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return boxes[a].low[0] < boxes[b].low[0]; });
  std::vector<std::vector<std::uint32_t>> beside(boxes.size());
  for (auto at = order.begin(); at != order.end(); ++at) {
    for (auto next = at + 1; next != order.end() && boxes[*next].low[0] <= boxes[*at].high[0]; ++next) {
      if (!touch(boxes[*at], boxes[*next])) continue;
      beside[*at].push_back(*next);
      beside[*next].push_back(*at);
    }
  }
  for (auto& others : beside) std::sort(others.begin(), others.end());
  return beside;
}

}  // namespace

Rectangle rectangle_around(std::span<const ExactSpot> spots) {
  // Errors are no less than 2^-51 of what they are of, so twice as much is more than is lost by rounding.
  const auto around = [](const ExactSpot& s) -> Rectangle {
    const double x = 2 * s.off[0], y = 2 * s.off[1];
    return {{s.x - x, s.y - y}, {s.x + x, s.y + y}};
  };
  Rectangle out = around(spots[0]);
  for (const ExactSpot& s : spots) out = hull_of(out, around(s));
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
  const auto beside = touching_pairs(boxes);
  std::vector<RimPart> rim;
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    for (std::uint32_t k = 0; k < polygons[i].size(); ++k) {
      EdgeOfUnion edge(polygons[i], k);
      for (const auto other : beside[i]) edge.cover_by(polygons[other]);
      edge.for_rim([&](ExactSegment segment) { rim.push_back({std::move(segment), i, k}); });
    }
  }
  return rim;
}

bool enters_interior(const ExactSegment& segment, const std::vector<ExactPolygon>& polygons) {
  return EdgeOfUnion(segment[0], segment[1]).enters_all(polygons);
}

}  // namespace clues::fastpath::solids
