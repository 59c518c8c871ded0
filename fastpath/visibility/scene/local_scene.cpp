#include "fastpath/visibility/scene/local_scene.h"

#include <algorithm>
#include <utility>

#include "exact/complex/complex.h"
#include "exact/kernel.h"
#include "exact/sight/scene_query.h"

namespace clues::fastpath {

namespace {

Rational rational(const exact::FT& x) { return x.exact(); }

ExactPoint taken_over(const exact::Point3& p) {
  const auto is_double = [](const exact::FT& x) { return x.approx().is_point(); };
  if (is_double(p.x()) && is_double(p.y()) && is_double(p.z()))
    return ExactPoint(Point{p.x().approx().inf(), p.y().approx().inf(), p.z().approx().inf()});
  return ExactPoint(Exact3{rational(p.x()), rational(p.y()), rational(p.z())});
}

}  // namespace

LocalScene::LocalScene(const scene::TriangleMesh& mesh, const exact::ConvexCell& given)
    : LocalScene(exact::build_complex(mesh, &given), given, given) {}

LocalScene::LocalScene(const exact::Complex& complex, const exact::ConvexCell& whole, const exact::ConvexCell& given,
                       std::span<const std::uint8_t> dark) {
  const std::vector<exact::Point3>& cell_vertices = whole.vertices();
  std::vector<bool> meets(complex.pieces.size(), false);
  CGAL::Bbox_3 cell_box = cell_vertices.front().bbox();
  for (const exact::Point3& s : cell_vertices) cell_box += s.bbox();
  for (std::size_t t = 0; t < complex.pieces.size(); ++t) {
    const auto& c = complex.pieces[t].corners;
    const std::array<exact::Point3, 3> corners{complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
    if (!CGAL::do_overlap(corners[0].bbox() + corners[1].bbox() + corners[2].bbox(), cell_box)) continue;
    meets[t] = exact::meets_cell(corners, whole);
  }

  const RoundedUp rounded_up;
  triangles = complex.input_triangles;
  refined_triangles = complex.refined_triangles;
  for (const exact::Point3& p : complex.points) points.push_back(taken_over(p));
  for (std::size_t t = 0; t < complex.pieces.size(); ++t) {
    LocalPiece piece;
    piece.corners = complex.pieces[t].corners;
    if (!complex.in_cell[t]) piece.edges = complex.piece_edges[t];
    for (const exact::Origin& o : complex.pieces[t].origins) piece.origins.push_back({o.triangle, o.same_side});
    piece.in_cell = complex.in_cell[t];
    piece.meets_cell = meets[t];
    piece.dark = !dark.empty() && !piece.in_cell &&
                 std::all_of(piece.origins.begin(), piece.origins.end(),
                             [&](const LocalOrigin& o) { return dark[o.triangle] != 0; });
    pieces.push_back(std::move(piece));
    const auto id = static_cast<std::uint32_t>(t);
    planes.emplace_back(corner(id, 0), corner(id, 1), corner(id, 2));
  }
  // Those at an edge or a point: of the scene, and dark.
  const auto divided = [&](const std::vector<std::uint32_t>& all) {
    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> parts;
    for (const std::uint32_t t : all) (pieces[t].dark ? parts.second : parts.first).push_back(t);
    return parts;
  };
  for (const exact::Edge& e : complex.edges) {
    auto [of_scene, of_dark] = divided(e.pieces);
    edges.push_back({e.a, e.b, std::move(of_scene)});
    dark_at_edge.push_back(std::move(of_dark));
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    auto [of_scene, of_dark] = divided(complex.point_pieces[p]);
    point_pieces.push_back(std::move(of_scene));
    dark_at_point.push_back(std::move(of_dark));
    point_edges.push_back(complex.point_edges[p]);
    std::erase_if(point_edges.back(), [this](std::uint32_t e) { return edges[e].pieces.empty(); });
  }

  cell.dimension = given.dimension();
  for (const exact::Point3& s : given.vertices()) cell.vertices.push_back(taken_over(s));
  cell.edges = given.edges();
  for (const exact::CellFacet& f : given.facets()) {
    const auto at = [&](std::size_t i) -> const ExactPoint& {
      return cell.vertices[static_cast<std::size_t>(f.corners[i])];
    };
    cell.facets.push_back(f.corners);
    cell.facet_planes.emplace_back(at(0), at(1), at(2));
  }

  bounds = cell.bounds();
  for (const ExactPoint& p : points) bounds = hull(bounds, p.approximate());
  std::vector<IntervalBox> boxes;
  for (std::uint32_t t = 0; t < pieces.size(); ++t) {
    if (pieces[t].in_cell || pieces[t].dark) continue;
    occluders.push_back(t);
    boxes.push_back(hull(hull(corner(t, 0).approximate(), corner(t, 1).approximate()), corner(t, 2).approximate()));
  }
  tree = BoxTree(boxes);
}

bool LocalCell::interior_contains(const ExactPoint& p) const {
  if (dimension < 3) return false;
  for (const Plane& f : facet_planes) {
    if (f.side(p) >= 0) return false;
  }
  return true;
}

IntervalBox LocalCell::bounds() const {
  IntervalBox box = vertices.front().approximate();
  for (const ExactPoint& v : vertices) box = hull(box, v.approximate());
  return box;
}

bool LocalCell::lies_in(const Plane& plane) const {
  return dimension < 3 &&
         std::all_of(vertices.begin(), vertices.end(), [&](const ExactPoint& s) { return plane.side(s) == 0; });
}

bool LocalCell::contains(const ExactPoint& p) const {
  if (dimension == 3) {
    for (const Plane& f : facet_planes) {
      if (f.side(p) > 0) return false;
    }
    return true;
  }
  if (dimension == 0) return equal(p, vertices[0]);
  if (dimension == 1) {
    if (!collinear(p, vertices[0], vertices[1])) return false;
    for (int k = 0; k < 3; ++k) {
      if (compare_coordinate(p, vertices[0], k) * compare_coordinate(p, vertices[1], k) > 0) return false;
    }
    return true;
  }
  // A polygon: in its plane, and inside every edge.
  const ExactPoint &a = vertices[0], &b = vertices[1], &c = vertices[2];
  if (orientation(a, b, c, p) != 0) return false;
  return decide([&]<class NT>() {
    const Vec3<NT> n = cross(coordinates<NT>(b) - coordinates<NT>(a), coordinates<NT>(c) - coordinates<NT>(a));
    for (const auto& [i, j] : edges) {
      const Vec3<NT> u = coordinates<NT>(vertices[static_cast<std::size_t>(i)]),
                     w = coordinates<NT>(vertices[static_cast<std::size_t>(j)]);
      const Vec3<NT> out = cross(w - u, n);
      int inner = 0;
      for (std::size_t k = 0; k < vertices.size() && inner == 0; ++k) {
        if (static_cast<int>(k) == i || static_cast<int>(k) == j) continue;
        inner = sign_of(NT(dot(out, coordinates<NT>(vertices[k]) - u)));
      }
      if (sign_of(NT(dot(out, coordinates<NT>(p) - u))) * inner < 0) return false;
    }
    return true;
  });
}

ExactPoint LocalCell::interior_point(const std::vector<double>& weights) const {
  if (dimension == 3) {
    Point sum{0, 0, 0};
    double total = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Point p = vertices[i].estimate();
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[i] * p[k];
      total += weights[i];
    }
    for (double& x : sum) x /= total;
    ExactPoint p(sum);
    if (interior_contains(p)) return p;
  }
  return combination(std::vector<Rational>(weights.begin(), weights.end()));
}

std::optional<ExactPoint> LocalCell::foot(const ExactPoint& p) const {
  if (dimension != 1 && dimension != 2) return std::nullopt;
  const Exact3 a = vertices[0].exact(), way = p.exact() - a;
  if (dimension == 1) {
    const Exact3 along = vertices[1].exact() - a;
    const Rational t = Rational(dot(way, along)) / Rational(dot(along, along));
    if (t <= 0 || t >= 1) return std::nullopt;
    return ExactPoint(a + t * along);
  }
  const Exact3& n = facet_planes[0].normal_exact();
  const Exact3 x = p.exact() - Rational(Rational(dot(way, n)) / Rational(dot(n, n))) * n;
  const std::vector<int>& polygon = facets[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact3 &from = vertices[static_cast<std::size_t>(polygon[i])].exact(),
                 &to = vertices[static_cast<std::size_t>(polygon[(i + 1) % polygon.size()])].exact();
    if (dot(n, cross(to - from, x - from)) <= 0) return std::nullopt;
  }
  return ExactPoint(x);
}

ExactPoint LocalCell::combination(const std::vector<Rational>& weights) const {
  Exact3 sum{0, 0, 0};
  Rational total = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum = sum + weights[i] * vertices[i].exact();
    total += weights[i];
  }
  return ExactPoint(Rational(1 / total) * sum);
}

Crossing LocalScene::crosses(const ExactPoint& v, const ExactPoint& p, std::uint32_t piece) const {
  const Plane& h = planes[piece];
  const int at_p = h.side(p), at_v = h.side(v);
  if (at_p == 0 && at_v == 0) {
    // In the plane: apart if all corners are strictly on one side of the line, or none is between its ends, or both ends are strictly beyond one edge.
    return decide([&]<class NT>() {
      const Vec3<NT> o = coordinates<NT>(v), along = coordinates<NT>(p) - o;
      const Vec3<NT> beside = cross(normal_of<NT>(h), along);
      int left = 0, right = 0, before = 0, behind = 0;
      bool beyond = false;
      for (int i = 0; i < 3; ++i) {
        const Vec3<NT> c = coordinates<NT>(corner(piece, i));
        const int s = sign_of(NT(dot(beside, c - o)));
        left += s > 0;
        right += s < 0;
        before += sign_of(NT(dot(along, c - o))) <= 0;
        behind += sign_of(NT(dot(along, c - coordinates<NT>(p)))) >= 0;
        const Vec3<NT> inward = cross(normal_of<NT>(h), coordinates<NT>(corner(piece, (i + 1) % 3)) - c);
        beyond =
            beyond || (sign_of(NT(dot(inward, o - c))) < 0 && sign_of(NT(dot(inward, coordinates<NT>(p) - c))) < 0);
      }
      return left == 3 || right == 3 || before == 3 || behind == 3 || beyond ? Crossing::no : Crossing::touch;
    });
  }
  if (at_p == 0 || at_v == 0 || at_p == at_v) return Crossing::no;
  bool touch = false;
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    const int s = orientation(v, p, corner(piece, i), corner(piece, (i + 1) % 3));
    if (s == 0) {
      touch = true;
    } else if (common == 0) {
      common = s;
    } else if (common != s) {
      return Crossing::no;
    }
  }
  return touch ? Crossing::touch : Crossing::yes;
}

bool LocalScene::faces_cell(std::uint32_t t, int side) const {
  return std::any_of(cell.vertices.begin(), cell.vertices.end(),
                     [&](const ExactPoint& v) { return planes[t].side(v) == side; });
}

bool LocalScene::may_meet(const ExactPoint& v, const ExactPoint& p) const {
  return tree.any(SegmentTest(v, p), [&](std::uint32_t i) { return crosses(v, p, occluders[i]) != Crossing::no; });
}

bool LocalScene::is_on_surface(const ExactPoint& x) const {
  const IntervalBox at = x.approximate();
  return tree.any([&](const IntervalBox& box) { return overlap(box, at); },
                  [&](std::uint32_t i) {
                    const std::uint32_t t = occluders[i];
                    const Plane& h = planes[t];
                    if (h.side(x) != 0) return false;
                    return decide([&]<class NT>() {
                      const Vec3<NT> n = normal_of<NT>(h), o = coordinates<NT>(x);
                      for (int k = 0; k < 3; ++k) {
                        const Vec3<NT> c = coordinates<NT>(corner(t, k));
                        const Vec3<NT> along = coordinates<NT>(corner(t, (k + 1) % 3)) - c;
                        if (sign_of(NT(dot(n, cross(along, o - c)))) < 0) return false;
                      }
                      return true;
                    });
                  });
}

LocalScene::Last LocalScene::last_crossing(const ExactPoint& v, const ExactPoint& p) const {
  Last out;
  const auto parameter = [&]<class NT>(std::uint32_t piece) {
    const Vec3<NT> n = normal_of<NT>(planes[piece]), o = coordinates<NT>(planes[piece].base());
    const NT at_v = dot(n, coordinates<NT>(v) - o), at_p = dot(n, coordinates<NT>(p) - o);
    return NT(at_v / NT(at_v - at_p));
  };
  out.degenerate = tree.any(SegmentTest(v, p), [&](std::uint32_t i) {
    const std::uint32_t t = occluders[i];
    const Crossing c = crosses(v, p, t);
    if (c == Crossing::touch) return true;
    if (c == Crossing::no) return false;
    const bool later = !out.piece || decide([&]<class NT>() {
      return sign_of(NT(parameter.template operator()<NT>(t) - parameter.template operator()<NT>(*out.piece))) > 0;
    });
    if (later) out.piece = t;
    return false;
  });
  return out;
}

}  // namespace clues::fastpath
