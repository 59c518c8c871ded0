// Where a walk (D14) would go on for ever: grooves, corners, and their slices where the cell is a segment. walk.h argues.
#include <algorithm>
#include <cmath>
#include <set>

#include "exact/complex/simple_point.h"
#include "reference/visibility/labels/corner.h"
#include "reference/visibility/labels/walk.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;
using exact::Vector3;

std::vector<Point3> Walker::ends_of_groove(const SurfaceSide& one, const SurfaceSide& two) const {
  std::vector<Point3> ends;
  const auto note = [&](const Point3& x) {
    if (!CGAL::is_negative(height(one, x)) && !CGAL::is_negative(height(two, x)) &&
        std::find(ends.begin(), ends.end(), x) == ends.end())
      ends.push_back(exact::collapsed(x));
  };
  for (const Point3& x : scene_->cell().vertices()) {
    if (!CGAL::is_negative(height(one, x))) note(x);
  }
  leaves(one, [&](const Point3&, const Point3& x) {
    note(x);
    return false;
  });
  return ends;
}

bool Walker::is_wall(std::uint32_t piece, const SurfaceSide& in, const SurfaceSide& before) const {
  const exact::Complex& complex = scene_->complex();
  const exact::Plane3 &plane = complex.planes[in.piece], &wall = complex.planes[before.piece];
  const auto& c = complex.pieces[piece].corners;
  const bool of_one_triangle =
      complex.pieces[piece].origins.front().triangle == complex.pieces[in.piece].origins.front().triangle;
  const auto front = before.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
  return (of_one_triangle ||
          std::all_of(c.begin(), c.end(), [&](auto i) { return plane.has_on(complex.points[i]); })) &&
         std::any_of(c.begin(), c.end(), [&](auto i) { return wall.oriented_side(complex.points[i]) == front; });
}

bool Walker::carries_both(const exact::Edge& e, const SurfaceSide& one, const SurfaceSide& two) const {
  const auto any = [&](const SurfaceSide& in, const SurfaceSide& before) {
    return std::any_of(e.pieces.begin(), e.pieces.end(), [&](auto t) { return is_wall(t, in, before); });
  };
  return any(one, two) && any(two, one);
}

Walker::Wall Walker::wall_of(const SurfaceSide& one, const SurfaceSide& other) const {
  const exact::Complex& complex = scene_->complex();
  Wall wall{{one.piece}, {}};
  std::set<std::uint32_t> met{one.piece};
  for (std::size_t i = 0; i < wall.pieces.size(); ++i) {
    for (const std::uint32_t id : complex.piece_edges[wall.pieces[i]]) {
      const exact::Edge& e = complex.edges[id];
      if (carries_both(e, one, other)) {
        wall.edges.push_back(id);
        continue;
      }
      for (const std::uint32_t t : e.pieces) {
        if (is_wall(t, one, other) && met.insert(t).second) wall.pieces.push_back(t);
      }
    }
  }
  return wall;
}

bool Walker::is_whole_at(std::uint32_t point, std::uint32_t from, std::uint32_t to, const SurfaceSide& wall,
                         const SurfaceSide& other) const {
  const exact::Complex& complex = scene_->complex();
  std::optional<std::uint32_t> piece;
  for (std::uint32_t edge = from; edge != to;) {
    const std::vector<std::uint32_t>& pieces = complex.edges[edge].pieces;
    const auto next = std::find_if(pieces.begin(), pieces.end(),
                                   [&](std::uint32_t t) { return t != piece && is_wall(t, wall, other); });
    if (next == pieces.end()) return false;
    piece = *next;
    const auto& edges = complex.piece_edges[*piece];
    edge = *std::find_if(edges.begin(), edges.end(), [&](std::uint32_t id) {
      return id != edge && (complex.edges[id].a == point || complex.edges[id].b == point);
    });
  }
  return true;
}

bool Walker::is_dark_over(std::uint32_t edge, const SurfaceSide& one, const SurfaceSide& two, const Point3& q,
                          const std::vector<Point3>& shared) const {
  if (std::any_of(shared.begin(), shared.end(),
                  [&](const Point3& x) { return !CGAL::is_zero(height(one, x)) || !CGAL::is_zero(height(two, x)); }))
    return false;

  // From the edge on, both ways along its line, as far as both walls stand: beyond, sight lines may come in.
  const exact::Complex& complex = scene_->complex();
  std::array<std::uint32_t, 2> ends{complex.edges[edge].a, complex.edges[edge].b};
  const auto next = [&](std::uint32_t last, std::uint32_t end, std::uint32_t other) -> std::optional<std::uint32_t> {
    for (const std::uint32_t t : complex.point_pieces[end]) {
      for (const std::uint32_t id : complex.piece_edges[t]) {
        const exact::Edge& e = complex.edges[id];
        if (e.a != end && e.b != end) continue;
        const Point3 &x = complex.points[other], &y = complex.points[end], &z = complex.points[e.a == end ? e.b : e.a];
        if (CGAL::collinear(x, y, z) && CGAL::collinear_are_ordered_along_line(x, y, z) && carries_both(e, one, two) &&
            is_whole_at(end, last, id, one, two) && is_whole_at(end, last, id, two, one))
          return id;
      }
    }
    return std::nullopt;
  };
  std::vector<GrooveEnd> passed;  // ends that V touches the line beyond
  for (const std::size_t i : {0U, 1U}) {
    std::uint32_t last = edge;
    while (const auto id = next(last, ends[i], ends[1 - i])) {
      last = *id;
      ends[i] = complex.edges[last].a == ends[i] ? complex.edges[last].b : complex.edges[last].a;
    }
    const Point3 &from = complex.points[ends[1 - i]], &end = complex.points[ends[i]];
    if (std::any_of(shared.begin(), shared.end(), [&](const Point3& x) {
          return x != end && CGAL::collinear_are_strictly_ordered_along_line(from, end, x);
        }))
      passed.push_back({ends[i], last});
  }
  const auto is_between_walls = [&](std::uint32_t piece) {
    const auto& c = complex.pieces[piece].corners;
    return std::any_of(c.begin(), c.end(), [&](auto i) {
      return CGAL::is_positive(height(one, complex.points[i])) && CGAL::is_positive(height(two, complex.points[i]));
    });
  };
  return std::none_of(passed.begin(), passed.end(),
                      [&](const GrooveEnd& end) {
                        const auto& pieces = complex.edges[end.edge].pieces;
                        return std::any_of(pieces.begin(), pieces.end(), is_between_walls);
                      }) &&
         (passed.empty() || closes_groove(complex, scene_->cell(), passed, q));
}

std::optional<Point3> Walker::along_groove(const Point3& p, const SurfaceSide& on, const SurfaceSide& before,
                                           const std::vector<Point3>& ends) const {
  // Ever nearer to an end, by powers of 8; mostly the first ones will do, or none, as the wall before holds the end.
  constexpr int kPulls[] = {0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 63};
  const exact::Complex& complex = scene_->complex();
  const Point3 far =
      choose(0, anchor_beyond(on, nullptr), [&](const Point3& x) { return CGAL::is_positive(height(on, x)); });
  // The wall may be in many pieces.
  const auto comes_through_it = [&](const exact::SegmentAnswer& answer) {
    if (answer.hits.empty()) return false;
    const auto& c = complex.pieces[answer.hits.back().piece].corners;
    return std::all_of(c.begin(), c.end(),
                       [&](auto i) { return complex.planes[before.piece].has_on(complex.points[i]); });
  };
  for (const Point3& end : ends) {
    for (const int pull : kPulls) {
      const Point3 v = exact::collapsed(end + FT(std::ldexp(1, -3 * pull)) * (far - end));
      if (scene_->meets(v, p, before.piece)) continue;
      const exact::SegmentAnswer answer = scene_->crossings(v, p);
      if (!answer.degenerate && !comes_through_it(answer)) return v;
    }
  }
  return std::nullopt;
}

bool Walker::divided_by_cell(const Point3& x, const Point3& y) const {
  if (scene_->cell().dimension() != 2) return false;
  const exact::Plane3& h = scene_->cell().facets()[0].plane;
  return CGAL::sign(exact::value_at(h, x)) * CGAL::sign(exact::value_at(h, y)) < 0;
}

std::optional<Leg> Walker::groove_leg(const Walk& walk, const std::vector<Point3>& shared) const {
  const std::size_t n = walk.legs.size();
  if (n < 4) return std::nullopt;
  const Leg &last = walk.legs[n - 1], &one = walk.legs[n - 2], &two = walk.legs[n - 3], &three = walk.legs[n - 4];
  const SurfaceSide wall{last.piece, last.front}, other{one.piece, one.front};
  if (!is_wall(two.piece, wall, other) || !is_wall(three.piece, other, wall)) return std::nullopt;
  const Point3 q = exact::collapsed(CGAL::midpoint(last.m, one.m));
  return scene_->cell().dimension() == 1 ? leg_in_slice(wall, other, q, shared.empty())
                                         : leg_from_edge(wall, other, q, shared);
}

std::optional<Leg> Walker::leg_from_edge(const SurfaceSide& wall, const SurfaceSide& other, const Point3& q,
                                         const std::vector<Point3>& shared) const {
  const exact::Complex& complex = scene_->complex();
  for (const std::uint32_t id : wall_of(wall, other).edges) {
    const exact::Edge& e = complex.edges[id];
    const Point3 &a = complex.points[e.a], &b = complex.points[e.b];
    const FT t = ((q - a) * (b - a)) / ((b - a) * (b - a));
    if (!CGAL::is_positive(t) || t >= FT(1)) continue;
    if (!shared.empty() && !is_dark_over(id, wall, other, q, shared)) continue;
    const Point3 y = exact::collapsed(a + t * (b - a));  // the foot of q on the edge
    if (divided_by_cell(y, q)) continue;
    if (!scene_->crossings(q, y).is_clear()) return std::nullopt;
    const auto at_edge =
        *std::find_if(e.pieces.begin(), e.pieces.end(), [&](auto i) { return is_wall(i, wall, other); });
    return Leg{y, q, at_edge, wall.front, true, false};
  }
  return std::nullopt;
}

// The plane through the cell and q has the normal n; the line of V divides it, and q is above that line.
std::optional<Leg> Walker::leg_in_slice(const SurfaceSide& wall, const SurfaceSide& other, const Point3& q,
                                        bool apart) const {
  const exact::Complex& complex = scene_->complex();
  const std::vector<Point3>& s = scene_->cell().vertices();
  const auto normal = [&](const SurfaceSide& on) {
    const Vector3 m = complex.planes[on.piece].orthogonal_vector();
    return on.front ? m : -m;
  };
  const Vector3 u = s[1] - s[0], n = CGAL::cross_product(u, q - s[0]), up = CGAL::cross_product(n, u);
  const Vector3 at_wall = normal(wall), at_other = normal(other);
  const FT volume = CGAL::cross_product(at_wall, at_other) * n;
  if (CGAL::is_zero(volume)) return std::nullopt;  // no tip in this slice
  if (!CGAL::is_positive(height(wall, q)) || !CGAL::is_positive(height(other, q))) return std::nullopt;
  // n * (y - s0) = 0, and y is in both planes.
  const Vector3 to_y = (-height(wall, s[0]) / volume) * CGAL::cross_product(at_other, n) +
                       (-height(other, s[0]) / volume) * CGAL::cross_product(n, at_wall);
  const Point3 y = exact::collapsed(s[0] + to_y);
  // The rays of the walls: in the slice and its plane, before the other wall.
  Vector3 along_wall = CGAL::cross_product(n, at_wall), along_other = CGAL::cross_product(n, at_other);
  if (CGAL::is_negative(along_wall * at_other)) along_wall = -along_wall;
  if (CGAL::is_negative(along_other * at_wall)) along_other = -along_other;
  const CGAL::Sign level = CGAL::sign(up * (y - s[0]));
  if (level == CGAL::NEGATIVE) return std::nullopt;
  const bool above = level == CGAL::ZERO && CGAL::is_positive(up * along_wall) && CGAL::is_positive(up * along_other);
  if (!apart && !above) return std::nullopt;
  const std::optional<std::uint32_t> piece = piece_from(y, along_wall, wall, other);
  if (!piece || !piece_from(y, along_other, other, wall)) return std::nullopt;
  if (!scene_->crossings(q, y).is_clear()) return std::nullopt;
  return Leg{y, q, *piece, wall.front, false, true};
}

std::optional<std::uint32_t> Walker::piece_from(const Point3& y, const Vector3& d, const SurfaceSide& wall,
                                                const SurfaceSide& other) const {
  const exact::Complex& complex = scene_->complex();
  const auto holds = [&](std::uint32_t t) {
    const auto& c = complex.pieces[t].corners;
    const Point3 &a = complex.points[c[0]], &b = complex.points[c[1]], &third = complex.points[c[2]];
    const Vector3 m = CGAL::cross_product(b - a, third - a);
    const auto inside = [&](const Point3& from, const Point3& to) {
      const Vector3 inwards = CGAL::cross_product(m, to - from);
      const CGAL::Sign at_y = CGAL::sign(inwards * (y - from));
      return at_y == CGAL::POSITIVE || (at_y == CGAL::ZERO && !CGAL::is_negative(inwards * d));
    };
    return inside(a, b) && inside(b, third) && inside(third, a);
  };
  const std::vector<std::uint32_t> pieces = wall_of(wall, other).pieces;
  const auto found = std::find_if(pieces.begin(), pieces.end(), holds);
  return found == pieces.end() ? std::nullopt : std::optional(*found);
}

std::optional<Leg> Walker::corner_leg(const Walk& walk) const {
  constexpr std::size_t kTurns = 6;
  const std::size_t n = walk.legs.size();
  if (n < kTurns || n % 3 != 0 || scene_->cell().dimension() == 1) return std::nullopt;  // leg_in_slice() sees to those
  const exact::Complex& complex = scene_->complex();
  const Leg& last = walk.legs.back();
  for (const std::uint32_t corner : complex.pieces[last.piece].corners) {
    const bool of_all = std::all_of(walk.legs.end() - kTurns, walk.legs.end(), [&](const Leg& leg) {
      const auto& c = complex.pieces[leg.piece].corners;
      return std::find(c.begin(), c.end(), corner) != c.end();
    });
    if (!of_all) continue;
    const Point3& y = complex.points[corner];
    const Point3 q = exact::collapsed(CGAL::midpoint(last.m, last.p));
    if (divided_by_cell(y, q)) continue;
    if (!scene_->crossings(q, y).is_clear()) continue;
    if (is_dark_corner(complex, scene_->cell(), corner, q - y)) return Leg{y, q, last.piece, last.front, false, true};
  }
  return leg_from_edge_at_corner(walk);
}

std::optional<Leg> Walker::leg_from_edge_at_corner(const Walk& walk) const {
  const std::size_t n = walk.legs.size();
  const Point3 q = exact::collapsed(CGAL::midpoint(walk.legs[n - 1].m, walk.legs[n - 1].p));
  for (const auto& [i, j] : {std::pair(n - 1, n - 2), std::pair(n - 1, n - 3), std::pair(n - 2, n - 3)}) {
    const SurfaceSide wall{walk.legs[i].piece, walk.legs[i].front}, other{walk.legs[j].piece, walk.legs[j].front};
    if (anchor_beyond(wall, &other) || !CGAL::is_positive(height(wall, q)) || !CGAL::is_positive(height(other, q)))
      continue;
    if (const std::optional<Leg> leg = leg_from_edge(wall, other, q, ends_of_groove(wall, other))) return leg;
  }
  return std::nullopt;
}

}  // namespace clues::reference
