// D3, D5 by CGAL, and segments that are hard on purpose.
#include "oracle.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "exact/sight/sight_segment.h"

namespace clues::fastpath {

using exact::FT;
using exact::Point3;
using exact::to_exact;
using exact::Vector3;

bool oracle_meets(const Segment& s, const Corners& t) {
  if (s.a == s.b) return false;
  return exact::blocks({to_exact(t[0]), to_exact(t[1]), to_exact(t[2])}, to_exact(s.a), false, to_exact(s.b));
}

std::optional<FT> oracle_first_block(const Segment& s, const Corners& t, const exact::ConvexCell* cell) {
  const Point3 a = to_exact(s.a), b = to_exact(s.b);
  if (a == b) return std::nullopt;
  const Point3 p[3] = {to_exact(t[0]), to_exact(t[1]), to_exact(t[2])};
  const Vector3 normal = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
  // x(k) = a + k (b - a): the constraints of the triangle, each linear in k.
  FT low(0), high(1);
  bool low_open = true, high_open = true;
  const FT plane_a = normal * (a - p[0]), plane_b = normal * (b - p[0]);
  if (plane_a == plane_b && plane_a != FT(0)) return std::nullopt;
  if (plane_a != plane_b) {
    low = high = plane_a / (plane_a - plane_b);
    if (low <= FT(0) || low >= FT(1)) return std::nullopt;
    low_open = high_open = false;
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3 inward = CGAL::cross_product(normal, p[(i + 1) % 3] - p[i]);
    const FT at_a = inward * (a - p[i]), at_b = inward * (b - p[i]), slope = at_b - at_a;
    if (low == high && !low_open) {
      if (at_a + low * slope < FT(0)) return std::nullopt;
    } else if (slope == FT(0)) {
      if (at_a < FT(0)) return std::nullopt;
    } else if (slope > FT(0) && -at_a / slope > low) {
      low = -at_a / slope;
      low_open = false;
    } else if (slope < FT(0) && -at_a / slope < high) {
      high = -at_a / slope;
      high_open = false;
    }
  }
  if (low > high || (low == high && (low_open || high_open))) return std::nullopt;
  if (cell == nullptr || cell->dimension() < 3) return low;  // D3: only the inside of a solid cell lets through
  // V is convex: a part is in int V when its middle is, its own ends are, and the ends it lacks are in V.
  const auto inside = [&](const FT& k, bool open) {
    const Point3 x = a + k * (b - a);
    return open ? cell->contains(x) : cell->interior_contains(x);
  };
  const bool middle = cell->interior_contains(a + ((low + high) / FT(2)) * (b - a));
  const bool starts_inside = inside(low, low_open);
  if (middle && starts_inside && inside(high, high_open)) return std::nullopt;
  FT leave = high;
  bool ever_inside = true;
  for (const exact::CellFacet& facet : cell->facets()) {
    const auto value = [&](const Point3& x) {
      return facet.plane.a() * x.x() + facet.plane.b() * x.y() + facet.plane.c() * x.z() + facet.plane.d();
    };
    const FT at_a = value(a), at_b = value(b);
    // At `low` and just behind it.
    const FT at_low = at_a + low * (at_b - at_a);
    ever_inside = ever_inside && (at_low < FT(0) || (low_open && at_low == FT(0) && at_b < at_a));
    if (at_b > at_a) leave = std::min(leave, FT(at_a / (at_a - at_b)));
  }
  return ever_inside ? leave : low;
}

std::vector<std::uint32_t> oracle_all_hits(const Segment& s, const scene::TriangleMesh& mesh,
                                           const exact::ConvexCell* cell) {
  std::vector<std::uint32_t> hits;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& c = mesh.triangles[i];
    const Corners t{mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]};
    if (CGAL::collinear(to_exact(t[0]), to_exact(t[1]), to_exact(t[2]))) continue;
    if (cell == nullptr ? oracle_meets(s, t) : oracle_first_block(s, t, cell).has_value()) hits.push_back(i);
  }
  return hits;
}

std::optional<std::uint32_t> oracle_first_hit(const Segment& s, const scene::TriangleMesh& mesh,
                                              const exact::ConvexCell* cell) {
  std::optional<std::uint32_t> best;
  FT least;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& c = mesh.triangles[i];
    const Corners t{mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]};
    if (CGAL::collinear(to_exact(t[0]), to_exact(t[1]), to_exact(t[2]))) continue;
    const auto where = oracle_first_block(s, t, cell);
    if (where && (!best || *where < least)) {
      best = i;
      least = *where;
    }
  }
  return best;
}

double random_double(fuzz::Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-52 - 1; }

double stepped(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, INFINITY);
  for (; steps < 0; ++steps) x = std::nextafter(x, -INFINITY);
  return x;
}

Segment aimed_segment(const scene::TriangleMesh& mesh, fuzz::Random& random) {
  Point low = mesh.points[0], high = low;
  for (const Point& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  const auto somewhere = [&] {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = low[k] + (high[k] - low[k]) * (0.5 + 0.6 * random_double(random));
    return p;
  };
  const auto nudged = [&](Point p) {
    const int most = random.one_in(2) ? 0 : 2;
    for (double& x : p) x = stepped(x, random.between(-most, most));
    return p;
  };
  const auto mixed = [](const Point& p, const Point& q, double k) {
    return Point{p[0] + k * (q[0] - p[0]), p[1] + k * (q[1] - p[1]), p[2] + k * (q[2] - p[2])};
  };
  const int last = static_cast<int>(mesh.triangles.size()) - 1;
  const auto corner_of = [&](int triangle, int i) {
    return mesh.points[mesh.triangles[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(i)]];
  };
  const int t = random.between(0, last), i = random.between(0, 2);
  const Point p = corner_of(t, i), q = corner_of(t, (i + 1) % 3), r = corner_of(t, (i + 2) % 3);
  const double k = random.between(0, 8) / 8.0;
  switch (random.between(0, 8)) {
    case 0:
      return {somewhere(), somewhere()};
    case 1: {  // through a corner
      const Point a = somewhere();
      return {a, nudged(mixed(a, p, 1 + k))};
    }
    case 2: {  // through an edge
      const Point a = somewhere();
      return {a, nudged(mixed(a, mixed(p, q, k), 2))};
    }
    case 3:
      return {nudged(mixed(p, q, -k)), nudged(mixed(p, q, 1 + k))};  // along an edge
    case 4:
      return {nudged(mixed(p, mixed(q, r, 0.5), -1)), nudged(mixed(p, q, 0.5))};  // in the plane
    case 5:
      return {somewhere(), nudged(mixed(mixed(p, q, 0.5), r, k))};  // ends on the triangle
    case 6:
      return {nudged(corner_of(random.between(0, last), i)), nudged(p)};  // from corner to corner
    case 7:
      return {nudged(mixed(p, q, k)), nudged(mixed(q, r, k))};  // within the triangle
    default: {                                                  // along an axis, through or beside a corner
      Point a = p, b = p;
      const auto axis = static_cast<std::size_t>(i);
      a[axis] = low[axis] - (high[axis] - low[axis]) * k;
      b[axis] = high[axis] + (high[axis] - low[axis]) * k;
      return {nudged(a), b};
    }
  }
}

scene::TriangleMesh moved(const scene::TriangleMesh& mesh, double factor, double offset) {
  scene::TriangleMesh out = mesh;
  for (Point& p : out.points) {
    for (double& x : p) x = x * factor + offset;
  }
  return out;
}

}  // namespace clues::fastpath
