// D2: the view cell as an exact convex polytope. Vertices are numbered lexicographically and facets by their corner
// lists, so that nothing downstream depends on the order of the input or on addresses.
#include "exact/cell/convex_cell.h"

// CGAL's empty static-filter functors confuse GCC's analysis at the point of instantiation, so this cannot be popped.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "scene/messages/error.h"

namespace clues::exact {
namespace {

// Whether `a`, `b`, `c` turn left when seen from the tip of `normal`; all lie in one plane with that normal.
CGAL::Sign turn(const Vector3& normal, const Point3& a, const Point3& b, const Point3& c) {
  return CGAL::sign(CGAL::scalar_product(normal, CGAL::cross_product(b - a, c - a)));
}

// Corners of the hull of coplanar points (sorted, unique), strictly convex, counter-clockwise about `normal`.
// Andrew's chain: lexicographic order in space is also an order along a line of the plane with ties broken.
std::vector<Point3> planar_hull(const std::vector<Point3>& sorted, const Vector3& normal) {
  std::vector<Point3> hull;
  const auto extend = [&](const Point3& p, std::size_t base) {
    while (hull.size() >= base + 2 && turn(normal, hull[hull.size() - 2], hull.back(), p) != CGAL::POSITIVE) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Point3& p : sorted) {
    extend(p, 0);
  }
  const std::size_t base = hull.size() - 1;
  for (auto p = sorted.rbegin() + 1; p != sorted.rend(); ++p) {
    extend(*p, base);
  }
  hull.pop_back();
  return hull;
}

void sort_unique(std::vector<Point3>& points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

// The facets of a full-dimensional hull as counter-clockwise polygons: coplanar hull triangles are merged.
std::vector<std::vector<Point3>> hull_polygons(const std::vector<Point3>& points) {
  using Mesh = CGAL::Surface_mesh<Point3>;
  Mesh mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);

  std::vector<std::size_t> parent(mesh.number_of_faces());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) {
      i = parent[i] = parent[parent[i]];
    }
    return i;
  };
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge(edge), g = mesh.opposite(h);
    if (CGAL::coplanar(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))),
                       mesh.point(mesh.target(mesh.next(g))))) {
      parent[root(mesh.face(h))] = root(mesh.face(g));
    }
  }
  std::map<std::size_t, std::vector<Point3>> corners;
  std::map<std::size_t, Vector3> normals;
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    const Point3 &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                 &c = mesh.point(mesh.target(mesh.next(h)));
    auto& group = corners[root(face)];
    group.insert(group.end(), {a, b, c});
    normals.emplace(root(face), CGAL::cross_product(b - a, c - a));
  }
  std::vector<std::vector<Point3>> polygons;
  for (auto& [id, group] : corners) {
    sort_unique(group);
    polygons.push_back(planar_hull(group, normals.at(id)));
  }
  return polygons;
}

// The dimension of the affine hull, and for dimension 2 the normal of the first turn in the given order.
int affine_dimension(const std::vector<Point3>& points, Vector3& normal) {
  const Point3& a = points.front();
  const auto b = std::find_if(points.begin(), points.end(), [&](const Point3& p) { return p != a; });
  if (b == points.end()) {
    return 0;
  }
  const auto c =
      std::find_if(points.begin(), points.end(), [&](const Point3& p) { return !CGAL::collinear(a, *b, p); });
  if (c == points.end()) {
    return 1;
  }
  normal = CGAL::cross_product(*b - a, *c - a);
  const bool flat =
      std::all_of(points.begin(), points.end(), [&](const Point3& p) { return CGAL::coplanar(a, *b, *c, p); });
  return flat ? 2 : 3;
}

Plane3 collapsed_plane(const Point3& a, const Point3& b, const Point3& c) {
  const Plane3 plane(a, b, c);
  return Plane3(collapsed(plane.a()), collapsed(plane.b()), collapsed(plane.c()), collapsed(plane.d()));
}

}  // namespace

ConvexCell::ConvexCell(const std::vector<Point3>& points) {
  if (points.empty()) {
    throw scene::Error(scene::ErrorCode::bad_cell, "the view cell has no point");
  }
  Vector3 normal;
  dimension_ = affine_dimension(points, normal);
  std::vector<Point3> sorted = points;
  sort_unique(sorted);

  std::vector<std::vector<Point3>> polygons;
  if (dimension_ == 3) {
    polygons = hull_polygons(sorted);
  } else if (dimension_ == 2) {
    polygons.push_back(planar_hull(sorted, normal));
  } else if (dimension_ == 1) {
    vertices_ = {sorted.front(), sorted.back()};
    edges_ = {{0, 1}};
  } else {
    vertices_ = {sorted.front()};
  }
  for (const auto& polygon : polygons) {
    vertices_.insert(vertices_.end(), polygon.begin(), polygon.end());
  }
  sort_unique(vertices_);
  for (Point3& v : vertices_) {
    v = collapsed(v);
  }

  std::set<std::array<int, 2>> edges;
  for (const auto& polygon : polygons) {
    CellFacet facet;
    for (const Point3& p : polygon) {
      facet.corners.push_back(
          static_cast<int>(std::lower_bound(vertices_.begin(), vertices_.end(), p) - vertices_.begin()));
    }
    auto& corners = facet.corners;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
    const auto at = [&](std::size_t i) -> const Point3& { return vertices_[static_cast<std::size_t>(corners[i])]; };
    facet.plane = collapsed_plane(at(0), at(1), at(2));
    facets_.push_back(std::move(facet));
  }
  std::sort(facets_.begin(), facets_.end(),
            [](const CellFacet& a, const CellFacet& b) { return a.corners < b.corners; });
  if (dimension_ >= 2) {
    edges_.assign(edges.begin(), edges.end());
  }
  center_ = interior_point(std::vector<int>(vertices_.size(), 1));
}

ConvexCell ConvexCell::from_doubles(const std::vector<scene::Point>& points) {
  std::vector<Point3> exact;
  exact.reserve(points.size());
  std::transform(points.begin(), points.end(), std::back_inserter(exact), to_exact);
  return ConvexCell(exact);
}

namespace {

template <class Weight>
Point3 combination(const std::vector<Point3>& vertices, const std::vector<Weight>& weights) {
  if (weights.size() != vertices.size() ||
      std::any_of(weights.begin(), weights.end(), [](Weight w) { return !(w > 0); }))
    throw scene::Error(scene::ErrorCode::internal, "interior_point needs one positive weight for each cell vertex");
  std::array<FT::Exact_type, 3> sum;
  FT::Exact_type total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto& v = CGAL::exact(vertices[i]);
    const FT::Exact_type weight = weights[i];
    for (int axis = 0; axis < 3; ++axis) sum[static_cast<std::size_t>(axis)] += v[axis] * weight;
    total += weight;
  }
  return {FT(sum[0] / total), FT(sum[1] / total), FT(sum[2] / total)};
}

}  // namespace

Point3 ConvexCell::interior_point(const std::vector<int>& weights) const { return combination(vertices_, weights); }
Point3 ConvexCell::interior_point(const std::vector<double>& weights) const { return combination(vertices_, weights); }

namespace {

// The least side over the constraints that bound the cell: negative outside, on the relative boundary, positive in int V.
CGAL::Sign depth(const ConvexCell& cell, const Point3& x) {
  const auto& vertices = cell.vertices();
  CGAL::Sign least = CGAL::POSITIVE;
  if (cell.dimension() == 0) {
    return x == vertices[0] ? CGAL::POSITIVE : CGAL::NEGATIVE;
  }
  if (cell.dimension() == 1) {
    if (x == vertices[0] || x == vertices[1]) {
      return CGAL::ZERO;
    }
    const bool between = CGAL::collinear(vertices[0], x, vertices[1]) && vertices[0] < x && x < vertices[1];
    return between ? CGAL::POSITIVE : CGAL::NEGATIVE;
  }
  if (cell.dimension() == 2) {
    const CellFacet& facet = cell.facets()[0];
    if (!facet.plane.has_on(x)) {
      return CGAL::NEGATIVE;
    }
    const std::size_t n = facet.corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point3& a = vertices[static_cast<std::size_t>(facet.corners[i])];
      const Point3& b = vertices[static_cast<std::size_t>(facet.corners[(i + 1) % n])];
      least = std::min(least, turn(facet.plane.orthogonal_vector(), a, b, x));
    }
    return least;
  }
  for (const CellFacet& facet : cell.facets()) {
    least = std::min(least, CGAL::opposite(static_cast<CGAL::Sign>(facet.plane.oriented_side(x))));
  }
  return least;
}

}  // namespace

bool ConvexCell::contains(const Point3& x) const { return depth(*this, x) != CGAL::NEGATIVE; }
bool ConvexCell::interior_contains(const Point3& x) const { return depth(*this, x) == CGAL::POSITIVE; }

}  // namespace clues::exact
