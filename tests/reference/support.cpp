#include "support.h"

#include <stdexcept>

#include "exact/complex/complex_internal.h"

namespace clues::test {

using exact::FT;
using exact::Point2;
using exact::Point3;

std::uint32_t SceneBuilder::point(const scene::Point& p) {
  mesh_.points.push_back(p);
  return static_cast<std::uint32_t>(mesh_.points.size() - 1);
}

std::uint32_t SceneBuilder::triangle(const scene::Point& a, const scene::Point& b, const scene::Point& c) {
  const auto id = static_cast<std::uint32_t>(mesh_.triangles.size());
  const std::uint32_t i = point(a), j = point(b), k = point(c);
  mesh_.triangles.push_back({i, j, k});
  mesh_.face_of.push_back(id);
  return id;
}

std::uint32_t SceneBuilder::quad(const scene::Point& a, const scene::Point& b, const scene::Point& c,
                                 const scene::Point& d) {
  const std::uint32_t id = triangle(a, b, c);
  triangle(a, c, d);
  return id;
}

std::uint32_t SceneBuilder::plate(double x0, double y0, double x1, double y1, double z) {
  return quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}

std::uint32_t SceneBuilder::box(const scene::Point& lo, const scene::Point& hi) {
  const auto p = [&](int i) {
    return scene::Point{i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]};
  };
  const std::uint32_t id = quad(p(0), p(2), p(3), p(1));
  quad(p(4), p(5), p(7), p(6));
  quad(p(0), p(1), p(5), p(4));
  quad(p(2), p(6), p(7), p(3));
  quad(p(0), p(4), p(6), p(2));
  quad(p(1), p(3), p(7), p(5));
  return id;
}

std::uint32_t SceneBuilder::prism(const std::vector<std::array<double, 2>>& polygon, double h,
                                  const std::vector<std::array<int, 3>>& cap) {
  const auto id = static_cast<std::uint32_t>(mesh_.triangles.size());
  const auto at = [&](std::size_t i, double z) { return scene::Point{polygon[i][0], polygon[i][1], z}; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = (i + 1) % polygon.size();
    quad(at(i, -h), at(j, -h), at(j, h), at(i, h));
  }
  for (const auto& c : cap) {
    const auto i = static_cast<std::size_t>(c[0]), j = static_cast<std::size_t>(c[1]),
               k = static_cast<std::size_t>(c[2]);
    triangle(at(i, h), at(j, h), at(k, h));
    triangle(at(i, -h), at(k, -h), at(j, -h));
  }
  return id;
}

exact::ConvexCell box_cell(double x0, double y0, double z0, double x1, double y1, double z1) {
  std::vector<scene::Point> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0});
  return exact::ConvexCell::from_doubles(corners);
}

reference::VisibilityMap map_of(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell,
                                const reference::Options& options) {
  reference::Options o = options;
  o.check_two_walks = true;
  return reference::first_order_visibility(mesh, cell, o);
}

namespace {

bool on_side(const reference::VisibilityMap& map, const reference::Region& r, std::uint32_t t, bool front) {
  for (const exact::Origin& o : map.complex.pieces[r.piece].origins) {
    if (o.triangle == t && (o.same_side == r.front) == front) return true;
  }
  return false;
}

FT twice_area(const std::vector<Point3>& ring) {  // of its shadow on the plane z = 0
  FT sum(0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

}  // namespace

FT hidden_area(const reference::VisibilityMap& map, const scene::TriangleMesh&, std::uint32_t first,
               std::uint32_t count, bool front) {
  FT sum(0);
  for (const reference::Region& r : map.regions) {
    if (r.visible) continue;
    for (std::uint32_t t = first; t < first + count; ++t) {
      if (!on_side(map, r, t, front)) continue;
      FT area(0);
      for (const auto& ring : r.rings) area += twice_area(ring);
      sum += CGAL::abs(area) / FT(2);
    }
  }
  return sum;
}

bool is_visible(const reference::VisibilityMap& map, std::uint32_t t, bool front, const scene::Point& x) {
  const Point3 p = exact::to_exact(x);
  for (const reference::Region& r : map.regions) {
    if (!on_side(map, r, t, front)) continue;
    const exact::Plane3& plane = map.complex.planes[r.piece];
    if (!plane.has_on(p)) continue;
    const int axis = exact::dominant_axis(plane.orthogonal_vector());
    const Point2 q = exact::drop_axis(p, axis);
    bool inside = false;
    for (const auto& ring : r.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 a = exact::drop_axis(ring[i], axis), b = exact::drop_axis(ring[(i + 1) % ring.size()], axis);
        const bool a_above = a.y() > q.y(), b_above = b.y() > q.y();
        if (a_above != b_above) inside ^= CGAL::orientation(a, b, q) == (b_above ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN);
      }
    }
    if (inside) return r.visible;
  }
  throw std::logic_error("the point lies in no region of that side");
}

bool quad_visible(const reference::VisibilityMap& map, std::uint32_t quad, bool front, const scene::Point& x) {
  try {
    return is_visible(map, quad, front, x);
  } catch (const std::logic_error&) {
    return is_visible(map, quad + 1, front, x);
  }
}

}  // namespace clues::test
