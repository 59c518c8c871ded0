#include "tests/validate/thin_cells.h"

#include <algorithm>
#include <utility>

namespace clues::validate::thin {
namespace {

using Polygon = std::vector<RVector>;

RVector negative(const RVector& a) { return times(a, Rational(-1)); }

int side_of(const Half& half, const RVector& x) { return sgn(dot(half.normal, minus(x, half.at))); }

bool any_inside(const Polygon& polygon, const Half& half) {
  return std::any_of(polygon.begin(), polygon.end(), [&](const RVector& x) { return side_of(half, x) > 0; });
}

Polygon cut(const Polygon& polygon, const Half& half) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RVector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational at_a = dot(half.normal, minus(a, half.at)), at_b = dot(half.normal, minus(b, half.at));
    if (sgn(at_a) >= 0) part.push_back(a);
    if (sgn(at_a) * sgn(at_b) < 0) part.push_back(sum(a, times(minus(b, a), Rational(at_a / (at_a - at_b)))));
  }
  return part;
}

// The corners of what a triangle shares with the plane of `half`.
Polygon section_with(const Triangle& t, const Half& half) {
  return cut(cut({t.begin(), t.end()}, half), {negative(half.normal), half.at});
}

RVector middle_of(const Polygon& polygon) {
  RVector total{};
  for (const RVector& x : polygon) total = sum(total, x);
  return times(total, Rational(Rational(1) / static_cast<unsigned long>(polygon.size())));
}

// The closed half space that holds `inside`, with a border through p; none when `inside` is on the border.
std::optional<Half> half_at(const RVector& p, const RVector& normal, const RVector& inside) {
  const int s = sgn(dot(normal, minus(inside, p)));
  if (s == 0) return std::nullopt;
  return Half{s > 0 ? normal : negative(normal), p};
}

RVector up_of(const Cell& polygon) {
  return cross(minus(polygon.corners[1], polygon.corners[0]), minus(polygon.corners[2], polygon.corners[0]));
}

// The edges of the polygon as half planes of its plane.
std::vector<Half> outline(const Cell& polygon) {
  const RVector up = up_of(polygon), middle = middle_of(polygon.corners);
  std::vector<Half> halves;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const RVector &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.corners.size()];
    halves.push_back(*half_at(a, cross(up, minus(b, a)), middle));
  }
  return halves;
}

// Where x lies on the line of the segment; none: beside it.
std::optional<Rational> place_on(const Cell& segment, const RVector& x) {
  const RVector d = minus(segment.corners[1], segment.corners[0]), to = minus(x, segment.corners[0]);
  if (!is_zero(cross(d, to))) return std::nullopt;
  return Rational(dot(d, to) / dot(d, d));
}

// p in the plane of the polygon: what lies behind the edge x y of something, or all the way from p if that
// holds p.
std::optional<std::vector<Half>> behind(const RVector& p, const RVector& x, const RVector& y, const RVector& up,
                                        bool from_p) {
  const auto beside_x = half_at(p, cross(up, minus(x, p)), y), beside_y = half_at(p, cross(up, minus(y, p)), x);
  if (!beside_x || !beside_y) return std::nullopt;
  std::vector<Half> halves{*beside_x, *beside_y};
  if (!from_p) halves.push_back({half_at(x, cross(up, minus(y, x)), sum(x, minus(x, p)))->normal, x});
  return halves;
}

bool covered_segment(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p,
                     const std::optional<RVector>& side) {
  const RVector &a = cell.corners[0], d = minus(cell.corners[1], a);
  Rational low = 0, high = 1;
  if (side) {
    const Rational at = dot(*side, minus(a, p)), slope = dot(*side, d);
    if (sgn(slope) == 0 && sgn(at) <= 0) return true;
    if (sgn(slope) > 0) low = std::max(low, Rational(-at / slope));
    if (sgn(slope) < 0) high = std::min(high, Rational(-at / slope));
  }
  std::vector<Interval> shadows;
  for (const Triangle& t : soup) {
    if (auto shadow = shadow_on_segment(cell, t, p)) shadows.push_back(std::move(*shadow));
  }
  std::sort(shadows.begin(), shadows.end(),
            [](const Interval& x, const Interval& y) { return y.low && (!x.low || *x.low < *y.low); });
  for (const Interval& s : shadows) {
    if (s.low && *s.low > low) break;  // a gap, unless it begins behind `high`
    if (!s.high) return true;
    low = std::max(low, *s.high);
  }
  return low >= high;
}

bool covered_polygon(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p,
                     const std::optional<RVector>& side) {
  std::vector<Polygon> rest{cell.corners};
  if (side) {
    if (!any_inside(cell.corners, {*side, p})) return true;
    rest = {cut(cell.corners, {*side, p})};
  }
  for (const Triangle& t : soup) {
    for (const auto& shadow : shadows_on_polygon(cell, t, p)) {
      std::vector<Polygon> left;
      for (Polygon piece : rest) {
        for (const Half& half : shadow) {
          const Half out{negative(half.normal), half.at};
          if (any_inside(piece, out)) left.push_back(cut(piece, out));
          if (!any_inside(piece, half)) {
            piece.clear();
            break;
          }
          piece = cut(piece, half);
        }
      }
      rest = std::move(left);
    }
  }
  return rest.empty();
}

}  // namespace

RVector normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

std::optional<Part> part_of_line(const Triangle& t, const RVector& from, const RVector& d) {
  const RVector n = normal_of(t);
  const Rational height = dot(n, minus(t[0], from)), slope = dot(n, d);
  if (sgn(slope) != 0) {
    const Rational s = height / slope;
    if (!holds(t, sum(from, times(d, s)))) return std::nullopt;
    return Part{s, s};
  }
  if (sgn(height) != 0) return std::nullopt;
  std::optional<Rational> low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    const RVector inward = cross(n, minus(t[(i + 1) % 3], t[i]));
    const Rational at = dot(inward, minus(from, t[i])), change = dot(inward, d);
    if (sgn(change) == 0) {
      if (sgn(at) < 0) return std::nullopt;
      continue;
    }
    const Rational s = -at / change;
    if (sgn(change) > 0 && (!low || *low < s)) low = s;
    if (sgn(change) < 0 && (!high || s < *high)) high = s;
  }
  if (*low > *high) return std::nullopt;
  return Part{*low, *high};
}

bool holds(const Triangle& t, const RVector& x) {
  const RVector n = normal_of(t);
  if (sgn(dot(n, minus(x, t[0]))) != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (sgn(dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(x, t[i]))) < 0) return false;
  }
  return true;
}

bool blocks(const Triangle& t, const RVector& v, const RVector& p) {
  const auto part = part_of_line(t, v, minus(p, v));
  return part && part->low < 1 && part->high > 0;
}

bool contains(const Cell& cell, const RVector& x) {
  if (cell.dimension() == 0) return x == cell.corners[0];
  if (cell.dimension() == 1) {
    const auto s = place_on(cell, x);
    return s && *s >= 0 && *s <= 1;
  }
  if (sgn(dot(up_of(cell), minus(x, cell.corners[0]))) != 0) return false;
  const auto halves = outline(cell);
  return std::all_of(halves.begin(), halves.end(), [&](const Half& h) { return side_of(h, x) >= 0; });
}

bool interior_contains(const Cell& cell, const RVector& x) {
  if (!contains(cell, x)) return false;
  if (cell.dimension() == 0) return true;
  if (cell.dimension() == 1) return x != cell.corners[0] && x != cell.corners[1];
  const auto halves = outline(cell);
  return std::all_of(halves.begin(), halves.end(), [&](const Half& h) { return side_of(h, x) > 0; });
}

bool meets(const Cell& cell, const Triangle& t) {
  const auto edge_meets = [](const Triangle& face, const RVector& a, const RVector& b) {
    const auto part = part_of_line(face, a, minus(b, a));
    return part && part->low <= 1 && part->high >= 0;
  };
  if (cell.dimension() == 0) return holds(t, cell.corners[0]);
  if (cell.dimension() == 1) return edge_meets(t, cell.corners[0], cell.corners[1]);
  const std::size_t n = cell.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (edge_meets(t, cell.corners[i], cell.corners[(i + 1) % n])) return true;
  }
  for (std::size_t i = 2; i < n; ++i) {
    const Triangle part{cell.corners[0], cell.corners[i - 1], cell.corners[i]};
    for (std::size_t k = 0; k < 3; ++k) {
      if (edge_meets(part, t[k], t[(k + 1) % 3])) return true;
    }
  }
  return false;
}

std::vector<Place> section(const Cell& segment, const Triangle& t, const RVector& p) {
  const RVector a = minus(segment.corners[0], p), d = minus(segment.corners[1], segment.corners[0]);
  const RVector n = cross(a, d);
  std::vector<Place> places;
  for (const RVector& x : section_with(t, {n, p})) {
    const RVector to = minus(x, p);
    places.push_back({dot(cross(to, d), n) / dot(n, n), dot(cross(a, to), n) / dot(n, n)});
  }
  return places;
}

std::optional<Interval> shadow_on_segment(const Cell& segment, const Triangle& t, const RVector& p) {
  if (const auto at_p = place_on(segment, p)) {  // seen end on
    const auto part = part_of_line(t, segment.corners[0], minus(segment.corners[1], segment.corners[0]));
    if (!part) return std::nullopt;
    if (sgn(*at_p) > 0) {
      if (part->low >= *at_p) return std::nullopt;
      return Interval{std::nullopt, std::min(part->high, *at_p)};
    }
    if (part->high <= *at_p) return std::nullopt;
    return Interval{std::max(part->low, *at_p), std::nullopt};
  }
  // The section between p, at r = 0, and the segment, at r = 1. The line from p to v(s) has u = s r.
  std::vector<RVector> places;
  for (const Place& x : section(segment, t, p)) places.push_back({x.r, x.u, 0});
  places = cut(cut(places, {{1, 0, 0}, {0, 0, 0}}), {{-1, 0, 0}, {1, 0, 0}});
  bool before_p = false, between = false, at_segment = false;
  for (const RVector& x : places) {
    before_p = before_p || sgn(x[0]) == 0;
    at_segment = at_segment || x[0] == 1;
    between = between || (sgn(x[0]) > 0 && x[0] < 1);
  }
  if (!between && !(before_p && at_segment)) return std::nullopt;  // only at p's height, or on the segment's line
  bool to_left = false, to_right = false;
  std::optional<Rational> low, high;
  for (const RVector& x : places) {
    if (sgn(x[0]) == 0) {
      to_left = to_left || sgn(x[1]) < 0;
      to_right = to_right || sgn(x[1]) > 0;
      continue;
    }
    const Rational s = x[1] / x[0];
    if (!low || s < *low) low = s;
    if (!high || s > *high) high = s;
  }
  return Interval{to_left ? std::nullopt : low, to_right ? std::nullopt : high};
}

std::vector<std::vector<Half>> shadows_on_polygon(const Cell& polygon, const Triangle& t, const RVector& p) {
  const RVector& at = polygon.corners[0];
  RVector up = up_of(polygon);
  const int height = sgn(dot(up, minus(p, at)));
  if (height == 0) {
    const Polygon part = section_with(t, {up, at});
    const bool holds_p = part.size() >= 3 && holds(t, p);
    std::vector<std::vector<Half>> all;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const RVector &x = part[i], &y = part[(i + 1) % part.size()];
      if (x == y) continue;
      if (auto halves = behind(p, x, y, up, holds_p)) all.push_back(std::move(*halves));
    }
    return all;
  }
  if (sgn(dot(normal_of(t), minus(p, t[0]))) == 0) return {};  // seen edge-on: a shadow without area
  if (height < 0) up = negative(up);
  const Half above{up, at}, below{negative(up), p};
  const Polygon part = cut(cut({t.begin(), t.end()}, above), below);
  if (!any_inside(part, above) || !any_inside(part, below)) return {};
  const RVector middle = middle_of(part);
  std::vector<Half> halves;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const RVector &x = part[i], &y = part[(i + 1) % part.size()];
    if (auto half = half_at(p, cross(minus(x, p), minus(y, p)), middle)) halves.push_back(std::move(*half));
  }
  return {std::move(halves)};
}

bool is_shaded(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p, const RVector& v) {
  return std::any_of(soup.begin(), soup.end(), [&](const Triangle& t) {
    if (cell.dimension() == 0) return blocks(t, v, p);
    if (cell.dimension() == 1) {
      const auto shadow = shadow_on_segment(cell, t, p);
      const auto s = place_on(cell, v);
      return shadow && (!shadow->low || *shadow->low <= *s) && (!shadow->high || *s <= *shadow->high);
    }
    const auto shadows = shadows_on_polygon(cell, t, p);
    return std::any_of(shadows.begin(), shadows.end(), [&](const std::vector<Half>& halves) {
      return std::all_of(halves.begin(), halves.end(), [&](const Half& h) { return side_of(h, v) >= 0; });
    });
  });
}

bool is_occluded(const Cell& cell, const std::vector<Triangle>& soup, const RVector& p,
                 const std::optional<RVector>& side) {
  if (cell.dimension() == 1) return covered_segment(cell, soup, p, side);
  if (cell.dimension() == 2) return covered_polygon(cell, soup, p, side);
  const RVector& v = cell.corners[0];
  return (side && sgn(dot(*side, minus(v, p))) <= 0) ||
         std::any_of(soup.begin(), soup.end(), [&](const Triangle& t) { return blocks(t, v, p); });
}

}  // namespace clues::validate::thin
