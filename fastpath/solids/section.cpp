#include "fastpath/solids/section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fastpath/solids/exact_sections.h"

namespace clues::fastpath::solids {
namespace {

constexpr std::size_t kMostSquares = 64;  // along each axis
constexpr double kSquaresPerPolygon = 1;

double turn_of(const Spot& a, const Spot& b, const Spot& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::size_t longest(const std::array<double, 3>& normal) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
  }
  return axis;
}

// Distances from the plane, and their range.
struct Distances {
  std::vector<double> all;
  double least = 0, most = 0;
};

void find_distances(const SectionPlane& plane, std::span<const Point> points, Distances& out) {
  out.all.clear();
  for (const Point& p : points) {
    const auto& n = plane.normal;
    out.all.push_back(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - plane.distance);
  }
  const auto [least, most] = std::minmax_element(out.all.begin(), out.all.end());
  out.least = *least;
  out.most = *most;
}

bool is_within(const Rectangle& box, const Spot& spot, double margin) {
  return spot[0] >= box.low[0] - margin && spot[0] <= box.high[0] + margin && spot[1] >= box.low[1] - margin &&
         spot[1] <= box.high[1] + margin;
}

Rectangle rectangle_around(std::span<const Spot> spots) {
  Rectangle out{spots[0], spots[0]};
  for (const Spot& s : spots) out = hull_of(out, {s, s});
  return out;
}

// Whether all of the box is on one side of the plane, but for roundings.
bool misses_box(const SectionPlane& plane, const Bounds& box) {
  double middle = -plane.distance, reach = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    middle += plane.normal[i] * (box.low[i] + box.high[i]) / 2;
    reach += std::fabs(plane.normal[i]) * (box.high[i] - box.low[i]) / 2;
  }
  return std::fabs(middle) > reach;
}

// The section in doubles: nobody relies on it.
std::vector<Spot> rough_section(const Solid& solid, const SectionPlane& plane, std::size_t u, std::size_t v) {
  static thread_local Distances at;
  static thread_local std::vector<Spot> spots;
  find_distances(plane, solid.corners, at);
  spots.clear();
  std::vector<Spot> hull;
  if (at.least >= 0 || at.most <= 0) return hull;
  for (std::size_t i = 0; i < solid.corners.size(); ++i) {
    if (at.all[i] == 0) spots.push_back({solid.corners[i][u], solid.corners[i][v]});
  }
  for (const auto& [i, j] : solid.edges) {
    if (at.all[i] * at.all[j] >= 0) continue;
    const double share = at.all[i] / (at.all[i] - at.all[j]);
    const Point &p = solid.corners[i], &q = solid.corners[j];
    spots.push_back({p[u] + share * (q[u] - p[u]), p[v] + share * (q[v] - p[v])});
  }
  if (spots.size() < 3) return hull;
  std::sort(spots.begin(), spots.end());
  hull_of_sorted(spots, turn_of, hull);
  return hull;
}

// Half of the plane: spots with x * spot[0] + y * spot[1] <= most.
struct HalfPlane {
  double x, y, most;
  double above(const Spot& s) const { return x * s[0] + y * s[1] - most; }
};

}  // namespace

Scale Scale::of(const Bounds& bounds) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    largest = std::max({largest, std::fabs(bounds.low[i]), std::fabs(bounds.high[i])});
  double power = std::exp2(std::ceil(std::log2(std::max(largest, std::numeric_limits<double>::min()))));
  if (power < largest) power *= 2;  // logarithms are rounded
  return {power};
}

Section::Section(const SectionPlane& plane, std::span<const Solid> solids, const Scale& scale)
    : plane_(plane), scale_(scale), dropped_(longest(plane.normal)), u_((dropped_ + 1) % 3), v_((dropped_ + 2) % 3) {
  std::vector<Rectangle> boxes;
  for (const Solid& solid : solids) {
    if (misses_box(plane_, solid.bounds)) continue;
    const Polygon polygon = rough_section(solid, plane_, u_, v_);
    if (polygon.size() < 3) continue;
    boxes.push_back(rectangle_around(polygon));
    all_ = of_.empty() ? boxes.back() : hull_of(all_, boxes.back());
    polygons_.add(polygon);
    of_.push_back(&solid);
  }
  squares_ = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::sqrt(kSquaresPerPolygon * static_cast<double>(of_.size()))), 1, kMostSquares);
  polygons_at_ = grid_of(boxes);
}

void Section::make_exact() const {
  std::vector<ExactPolygon> exact;
  std::vector<const Solid*> of;
  std::vector<Rectangle> of_polygons, of_rim;
  for (const Solid* solid : of_) {
    auto polygon = section_of(*solid, plane_, dropped_, Cutting::across);
    if (!polygon) continue;
    Polygon rounded;
    for (const auto& spot : *polygon) rounded.push_back({spot.x, spot.y});
    exact_.polygons.add(rounded);
    of_polygons.push_back(rectangle_around(rounded));
    exact.push_back(std::move(*polygon));
    of.push_back(solid);
  }
  for (const auto& [segment, polygon, edge] : rim_of_union(exact)) {
    const auto side = exact[polygon][edge].side;
    exact_.rim.push_back({{segment[0].x, segment[0].y},
                          {segment[1].x, segment[1].y},
                          side < 0 ? nullptr : &of[polygon]->sides[static_cast<std::size_t>(side)]});
    of_rim.push_back(rectangle_around(std::array{exact_.rim.back().a, exact_.rim.back().b}));
  }
  exact_.polygons_at = grid_of(of_polygons);
  exact_.rim_at = grid_of(of_rim);
}

// Rises with x, so that what two ranges share is in a square of both.
std::size_t Section::square(double x, std::size_t axis) const {
  const double width = (all_.high[axis] - all_.low[axis]) / static_cast<double>(squares_);
  if (!(width > 0)) return 0;
  const double at = (x - all_.low[axis]) / width;
  return at <= 0 ? 0 : std::min(static_cast<std::size_t>(at), squares_ - 1);
}

Section::Grid Section::grid_of(const std::vector<Rectangle>& boxes) const {
  Grid grid;
  grid.first.assign(squares_ * squares_ + 1, 0);
  const auto for_each_square = [&](const Rectangle& range, const auto& f) {
    const std::size_t last_x = square(range.high[0], 0), last_y = square(range.high[1], 1);
    for (std::size_t x = square(range.low[0], 0); x <= last_x; ++x) {
      for (std::size_t y = square(range.low[1], 1); y <= last_y; ++y) f(x * squares_ + y);
    }
  };
  for (const Rectangle& box : boxes) for_each_square(box, [&](std::size_t at) { ++grid.first[at + 1]; });
  std::partial_sum(grid.first.begin(), grid.first.end(), grid.first.begin());
  grid.entries.resize(grid.first.back());
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for_each_square(boxes[i], [&](std::size_t at) { grid.entries[next[at]++] = {boxes[i], i}; });
  return grid;
}

bool Section::is_in_one(const Polygons& polygons, const Grid& at, const Spot& spot, double depth) const {
  const std::size_t here = square(spot[0], 0) * squares_ + square(spot[1], 1);
  for (std::uint32_t i = at.first[here]; i < at.first[here + 1]; ++i) {
    const auto& [box, id] = at.entries[i];
    if (!is_within(box, spot, std::max(0.0, -depth))) continue;
    const std::uint32_t first = polygons.first[id], end = polygons.first[id + 1];
    bool inside = true;
    for (std::uint32_t k = first; inside && k < end; ++k) {
      const Spot &a = polygons.corners[k], &b = polygons.corners[k + 1 < end ? k + 1 : first];
      inside = turn_of(a, b, spot) > depth * (std::fabs(b[0] - a[0]) + std::fabs(b[1] - a[1]));
    }
    if (inside) return true;
  }
  return false;
}

bool Section::holds(const Spot& spot) const {
  return is_in_one(exact_.polygons, exact_.polygons_at, spot, scale_.margin() * 0x1p-4);
}

bool Section::misses(const Spot& spot) const {
  const double margin = scale_.margin();
  return !is_within(all_, spot, margin) || !is_in_one(polygons_, polygons_at_, spot, -margin);
}

bool Section::rim_meets(const Polygon& window, const Piece& from_piece, const Piece& to_piece) const {
  const double margin = scale_.margin();
  Rectangle range{window[0], window[0]};
  static thread_local std::vector<HalfPlane> halves;
  halves.clear();
  for (std::size_t i = 0; i < window.size(); ++i) {
    const Spot &a = window[i], &b = window[(i + 1) % window.size()];
    range = hull_of(range, {a, a});
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length < margin) continue;  // the half planes of its neighbours, and the range, have what it would cut off
    const double x = (b[1] - a[1]) / length, y = (a[0] - b[0]) / length;
    halves.push_back({x, y, x * a[0] + y * a[1] + margin});
  }
  for (std::size_t k = 0; k < 2; ++k) {
    range.low[k] -= margin;
    range.high[k] += margin;
  }
  const std::size_t last_x = square(range.high[0], 0), last_y = square(range.high[1], 1);
  for (std::size_t x = square(range.low[0], 0); x <= last_x; ++x) {
    for (std::size_t y = square(range.low[1], 1); y <= last_y; ++y) {
      const std::size_t at = x * squares_ + y;
      for (std::uint32_t i = exact_.rim_at.first[at]; i < exact_.rim_at.first[at + 1]; ++i) {
        const auto& [a, b, side] = exact_.rim[exact_.rim_at.entries[i].id];
        bool apart = false;
        for (std::size_t k = 0; k < 2; ++k)
          apart =
              apart || (a[k] < range.low[k] && b[k] < range.low[k]) || (a[k] > range.high[k] && b[k] > range.high[k]);
        double from = 0, to = 1;
        for (std::size_t h = 0; !apart && h < halves.size(); ++h) {
          const double at_a = halves[h].above(a), at_b = halves[h].above(b);
          if (at_a > 0 && at_b > 0) {
            apart = true;
          } else if (at_a > 0) {
            from = std::max(from, at_a / (at_a - at_b));
          } else if (at_b > 0) {
            to = std::min(to, at_a / (at_a - at_b));
          }
          apart = apart || from > to;
        }
        if (!apart && !(side != nullptr && is_inside(*side, from_piece, scale_) && is_inside(*side, to_piece, scale_)))
          return true;
      }
    }
  }
  return false;
}

bool is_inside(const Side& side, const Piece& piece, const Scale& scale) {
  const auto is_not_outside = [&](const Point& p) { return side.side_of(p) <= 0; };
  const auto has_none_outside = [&](const Bounds& box) {
    const auto corners = scene::corners_of(box);
    return std::all_of(corners.begin(), corners.end(), is_not_outside);
  };
  const double off = scale.margin() * 0x1p-18;  // by much less the corners are, where they were cut
  const auto is_well_inside = [&](const Point& p) {
    return has_none_outside({{p[0] - off, p[1] - off, p[2] - off}, {p[0] + off, p[1] + off, p[2] + off}});
  };
  return has_none_outside(piece.box) || std::all_of(piece.whole.begin(), piece.whole.end(), is_not_outside) ||
         std::all_of(piece.corners.begin(), piece.corners.end(), is_well_inside);
}

bool Section::covers(const Piece& from_piece, const Piece& to_piece) const {
  const auto &from = from_piece.corners, &to = to_piece.corners;
  if (of_.empty()) return false;
  static thread_local Distances of_from, of_to;
  static thread_local std::vector<Spot> crossings, window;
  const double clearance = scale_.clearance();
  find_distances(plane_, from, of_from);
  find_distances(plane_, to, of_to);
  const bool up = of_from.most <= -clearance && of_to.least >= clearance;
  const bool down = of_from.least >= clearance && of_to.most <= -clearance;
  if (!up && !down) return false;
  crossings.clear();
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (std::size_t k = 0; k < to.size(); ++k) {
      const double share = of_from.all[i] / (of_from.all[i] - of_to.all[k]);
      const Point &a = from[i], &b = to[k];
      const Spot s{a[u_] + share * (b[u_] - a[u_]), a[v_] + share * (b[v_] - a[v_])};
      if (misses(s)) return false;
      crossings.push_back(s);
    }
  }
  std::call_once(exact_made_, [this] { make_exact(); });
  std::sort(crossings.begin(), crossings.end());
  hull_of_sorted(crossings, turn_of, window);  // what lies on an edge but for a rounding may be missing
  const Spot middle = middle_of(window);
  bool held = holds(middle);
  for (std::size_t i = 0; !held && i < window.size(); ++i)
    held = holds({(middle[0] + window[i][0]) / 2, (middle[1] + window[i][1]) / 2});
  return held && !rim_meets(window, from_piece, to_piece);
}

}  // namespace clues::fastpath::solids
