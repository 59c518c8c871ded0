#include "reference/visibility/hidden/inside_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "exact/cell/direction_cone.h"
#include "reference/visibility/hidden/boundary_simplification.h"

namespace clues::reference {

using exact::FT;
using exact::Plane3;
using exact::Point2;
using exact::Point3;
using exact::Vector3;

namespace {

using Key = std::array<FT, 3>;

// The same for two directions exactly when they are the same.
Key key_of(const Vector3& d) {
  const FT scale = std::max({CGAL::abs(d.x()), CGAL::abs(d.y()), CGAL::abs(d.z())});
  return {exact::collapsed(d.x() / scale), exact::collapsed(d.y() / scale), exact::collapsed(d.z() / scale)};
}

// A wedge of another source whose lateral bound runs on from x.
struct Neighbour {
  Plane3 plane;
  Vector3 along;  // from its source to x
  Vector3 aside;  // from the bound into the wedge
};

// The lateral bound of w that passes through x, or starts there, and goes on.
std::optional<Neighbour> ends_at(const Wedge& w, const Point3& x) {
  if (w.center == x || !w.plane.has_on(x)) return std::nullopt;
  const Vector3 d = x - w.center;
  for (const bool second : {false, true}) {
    const Point3 &on_ray = second ? w.on_ray1 : w.on_ray0, &near = second ? w.near1 : w.near0,
                 &far = second ? w.far1 : w.far0;
    if (!CGAL::collinear(w.center, on_ray, x) || !CGAL::is_positive((on_ray - w.center) * d)) continue;
    const bool begins = !CGAL::is_negative((x - near) * d), goes_on = w.unbounded || CGAL::is_positive((far - x) * d);
    if (begins && goes_on) return Neighbour{w.plane, d, (second ? w.on_ray0 : w.on_ray1) - on_ray};
  }
  return std::nullopt;
}

// The one of them that the chain ends at with this ray; none if there are several in different planes.
std::optional<Neighbour> neighbour(const std::vector<Neighbour>& at_x, const Vector3& ray) {
  std::optional<Neighbour> found;
  for (const Neighbour& n : at_x) {
    if (CGAL::cross_product(n.along, ray) != CGAL::NULL_VECTOR) continue;
    if (found && found->plane != n.plane) return std::nullopt;
    found = n;
  }
  return found;
}

// The direction in both planes that lies beyond the bound `ray0` of the one and `ray1` of the other.
std::optional<Vector3> line_of(const Neighbour& a, const Vector3& ray0, const Neighbour& b, const Vector3& ray1) {
  const Vector3 line = CGAL::cross_product(a.plane.orthogonal_vector(), b.plane.orthogonal_vector());
  if (line == CGAL::NULL_VECTOR) return std::nullopt;
  const auto side = [](const Neighbour& n, const Vector3& ray, const Vector3& d) {
    return CGAL::sign(CGAL::cross_product(n.plane.orthogonal_vector(), ray) * d);
  };
  const CGAL::Sign at_a = side(a, ray0, line) * side(a, ray0, a.aside);
  const CGAL::Sign at_b = side(b, ray1, line) * side(b, ray1, b.aside);
  if (at_a == CGAL::ZERO || at_a != at_b) return std::nullopt;
  return at_a == CGAL::NEGATIVE ? line : -line;
}

// The chains of swept wedges at x: paths in the graph of their rays.
std::vector<std::vector<InsideCorner::Swept>> chains_at(const std::vector<const Wedge*>& swept, const Point3& x) {
  std::map<Key, std::vector<std::size_t>> at_ray;
  for (std::size_t i = 0; i < swept.size(); ++i) {
    at_ray[key_of(swept[i]->on_ray0 - x)].push_back(i);
    at_ray[key_of(swept[i]->on_ray1 - x)].push_back(i);
  }
  std::vector<std::vector<InsideCorner::Swept>> chains;
  std::vector<bool> used(swept.size(), false);
  for (const auto& [start, first] : at_ray) {
    if (first.size() != 1 || used[first[0]]) continue;
    std::vector<InsideCorner::Swept> chain;
    bool is_path = true;
    Key at = start;
    for (std::size_t i = first[0];;) {
      used[i] = true;
      Vector3 from = swept[i]->on_ray0 - x, to = swept[i]->on_ray1 - x;
      if (key_of(from) != at) std::swap(from, to);
      chain.push_back({swept[i]->plane, from, to});
      at = key_of(to);
      const std::vector<std::size_t>& next = at_ray.at(at);
      if (next.size() == 1) break;
      i = next[0] == i ? next[1] : next[0];
      is_path = is_path && next.size() == 2 && !used[i];
      if (!is_path) break;
    }
    if (is_path) chains.push_back(std::move(chain));
  }
  return chains;
}

bool runs_along(const DmSegment& s, const InsideCorner& corner) {
  return std::any_of(corner.chain.begin(), corner.chain.end(), [&](const InsideCorner::Swept& swept) {
    if (!swept.plane.has_on(s.a) || !swept.plane.has_on(s.b)) return false;
    const Vector3 n = CGAL::cross_product(swept.ray0, swept.ray1), d = CGAL::midpoint(s.a, s.b) - corner.x;
    return CGAL::is_positive(CGAL::cross_product(swept.ray0, d) * n) &&
           CGAL::is_positive(CGAL::cross_product(d, swept.ray1) * n);
  });
}

// The cone between chain and planes, on the triangle.
FlatSet between(const InsideCorner& corner, const exact::Complex& complex, std::uint32_t piece,
                const TriangleFrame& frame) {
  const FT twice = frame.twice_area();
  FlatSet all(twice);
  for (const InsideCorner::Swept& swept : corner.chain) {
    std::vector<Point3> part;
    for (const std::uint32_t c : complex.pieces[piece].corners) part.push_back(complex.points[c]);
    const std::array<Vector3, 3> rays{swept.ray0, swept.ray1, corner.line};
    for (std::size_t k = 0; k < 3 && part.size() >= 3; ++k) {
      Plane3 side(corner.x, CGAL::cross_product(rays[k], rays[(k + 1) % 3]));
      if (side.oriented_side(corner.x + rays[(k + 2) % 3]) == CGAL::ON_NEGATIVE_SIDE) side = side.opposite();
      part = exact::clipped(part, side);
    }
    Ring2 ring;
    for (const Point3& p : part) {
      const Point2 q = frame.frame()(p);
      const Point2 short_q(exact::collapsed(q.x()), exact::collapsed(q.y()));
      if (ring.empty() || (ring.back() != short_q && ring.front() != short_q)) ring.push_back(short_q);
    }
    if (ring.size() < 3) continue;
    const FT area = twice_area(ring);
    if (CGAL::is_zero(area)) continue;
    if (CGAL::is_negative(area)) std::reverse(ring.begin(), ring.end());
    all = unite(all, FlatSet(twice, {Face2{ring}}));
  }
  return all;
}

// Whether an edge of the face and the segment have more than a point in common.
bool borders_on(const Face2& face, const Point2& a, const Point2& b) {
  for (const Ring2& ring : face) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
      if (!CGAL::collinear(a, b, p) || !CGAL::collinear(a, b, q)) continue;
      if (std::max(std::min(a, b), std::min(p, q)) < std::min(std::max(a, b), std::max(p, q))) return true;
    }
  }
  return false;
}

std::size_t segments_of(const FlatSet& hidden, const TriangleFrame& frame) {
  std::size_t n = 0;
  for (const Face2& face : hidden.faces()) n += boundary_segments(face, frame.flat());
  return n;
}

}  // namespace

bool InsideCorner::within(double degrees) const {
  if (degrees >= 90) return true;
  const FT cosine(std::cos(degrees * std::numbers::pi / 180));
  const auto is_near = [&](const Vector3& ray) {
    const FT dot = line * ray;
    return CGAL::is_positive(dot) && dot * dot >= cosine * cosine * line.squared_length() * ray.squared_length();
  };
  return std::all_of(chain.begin(), chain.end(), [&](const Swept& s) { return is_near(s.ray0) && is_near(s.ray1); });
}

std::vector<InsideCorner> inside_corners(const VisibilityMap& map) {
  std::map<Point3, std::vector<const Wedge*>> swept_at;
  for (const Wedge& w : map.wedges) {
    if (w.kind == WedgeKind::se_mv) swept_at[w.center].push_back(&w);
  }
  std::vector<InsideCorner> corners;
  for (const auto& [x, swept] : swept_at) {
    std::vector<Neighbour> at_x;
    for (const Wedge& w : map.wedges) {
      if (auto n = ends_at(w, x)) at_x.push_back(std::move(*n));
    }
    for (auto& chain : chains_at(swept, x)) {
      const Vector3 &first = chain.front().ray0, &last = chain.back().ray1;
      const auto a = neighbour(at_x, first), b = neighbour(at_x, last);
      if (!a || !b) continue;
      const auto line = line_of(*a, first, *b, last);
      if (!line) continue;
      const bool beyond = std::all_of(chain.begin(), chain.end(), [&](const InsideCorner::Swept& s) {
        return CGAL::is_negative(s.plane.orthogonal_vector() * *line);  // on the H+ side of the chain
      });
      if (beyond) corners.push_back({x, *line, std::move(chain)});
    }
  }
  return corners;
}

FlatSet hidden_by_planes(const FlatSet& hidden, const exact::Complex& complex, std::uint32_t piece,
                         const std::vector<const DmSegment*>& boundary, const std::vector<InsideCorner>& corners,
                         std::vector<char>& taken) {
  const TriangleFrame frame(complex, piece);
  FlatSet rest = hidden;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    std::vector<const DmSegment*> traces;
    std::copy_if(boundary.begin(), boundary.end(), std::back_inserter(traces),
                 [&](const DmSegment* s) { return runs_along(*s, corners[i]); });
    if (traces.empty()) continue;
    FlatSet given_up(frame.twice_area());
    for (const Face2& face : intersect(rest, between(corners[i], complex, piece, frame)).faces()) {
      const bool cut_off = std::any_of(traces.begin(), traces.end(), [&](const DmSegment* s) {
        return borders_on(face, frame.frame()(s->a), frame.frame()(s->b));
      });
      if (cut_off) given_up = unite(given_up, FlatSet(frame.twice_area(), {face}));
    }
    if (given_up.empty()) continue;
    FlatSet fewer = subtract(rest, given_up);
    if (segments_of(fewer, frame) >= segments_of(rest, frame)) continue;
    taken[i] = 1;
    rest = std::move(fewer);
  }
  return rest;
}

}  // namespace clues::reference
