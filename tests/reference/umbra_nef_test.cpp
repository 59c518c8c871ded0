// Umbrae against CGAL's Nef polyhedra, which know nothing of wedges. What one convex blocker hides from V is what it hides from every vertex of V: the
// intersection of its shadows. Two blockers that do not fuse hide the union of what each hides.
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include "reference/visibility/hidden/umbra.h"
#include "support.h"
#include "validate/certificates/umbra_certificate.h"
#include "validate/certificates/umbra_file.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Kernel;
using exact::Point3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Nef hull(const std::vector<Point3>& points) {
  Polyhedron p;
  CGAL::convex_hull_3(points.begin(), points.end(), p);
  return Nef(p);
}

FT volume(const Nef& nef) {
  Polyhedron p;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(nef, p, true);
  FT six(0);
  for (auto f = p.facets_begin(); f != p.facets_end(); ++f) {
    auto h = f->facet_begin();
    const Point3 a = (h++)->vertex()->point(), b = (h++)->vertex()->point(), c = h->vertex()->point();
    six += CGAL::determinant(a - CGAL::ORIGIN, b - CGAL::ORIGIN, c - CGAL::ORIGIN);
  }
  return six / FT(6);
}

constexpr double kEnd = 6;  // bounds: |x|, |y| <= 6, -1 <= z <= 6

Nef bounds() {
  std::vector<Point3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 6 : -6, i & 2 ? 6 : -6, i & 4 ? 6 : -1);
  return hull(corners);
}

// All that the convex blocker hides from every vertex of the cell, within the bounds.
Nef hidden_by(const std::vector<Point3>& blocker, const exact::ConvexCell& cell) {
  Nef hidden = bounds();
  for (const Point3& v : cell.vertices()) {
    std::vector<Point3> shadow = blocker;
    for (const Point3& k : blocker) shadow.push_back(k + FT(40) * (k - v));
    hidden = hidden * hull(shadow);
  }
  return hidden;
}

FT umbra_volume(const scene::TriangleMesh& mesh, const exact::ConvexCell& cell) {
  const reference::Omega omega(mesh, cell, {});
  const reference::Box box{Point3(-6, -6, -1), Point3(kEnd, kEnd, kEnd)};
  const auto record = validate::record_of(reference::build_umbra(omega, box, 0));
  EXPECT_TRUE(validate::check_umbra_certificate(mesh, cell, record.facets).valid);
  return FT(FT::Exact_type(validate::enclosed_volume(record.facets).get_str()));
}

struct Tetrahedron {
  std::array<scene::Point, 4> p;
  void add_to(SceneBuilder& s) const {
    s.triangle(p[0], p[2], p[1]);
    s.triangle(p[0], p[1], p[3]);
    s.triangle(p[1], p[2], p[3]);
    s.triangle(p[2], p[0], p[3]);
  }
  std::vector<Point3> points() const {
    std::vector<Point3> all;
    for (const scene::Point& x : p) all.push_back(exact::to_exact(x));
    return all;
  }
};

TEST(UmbraAgainstNef, OneTetrahedron) {
  const Tetrahedron t{{{{-2, -1, 1.5}, {2, -1.5, 1}, {0.5, 2, 1.25}, {0.25, 0, 3}}}};
  for (const auto& cell : {box_cell(-1, -1, -0.5, 0.5, 1, 0), box_cell(-0.5, -0.25, 0, 0.5, 0.75, 0)}) {
    SceneBuilder s;
    t.add_to(s);
    EXPECT_EQ(umbra_volume(s.mesh(), cell), volume(hidden_by(t.points(), cell)));
  }
}

TEST(UmbraAgainstNef, TwoTetrahedraApart) {
  const Tetrahedron t{{{{-4, -1, 1.5}, {-2, -1.5, 1}, {-2.5, 2, 1.25}, {-3, 0, 2}}}};
  const Tetrahedron u{{{{2.5, -1, 2.5}, {4, -1.5, 2}, {3.5, 1, 2.25}, {3, 0, 3}}}};
  const auto cell = box_cell(-0.5, -0.5, -0.5, 0.5, 0.5, 0);
  SceneBuilder s;
  t.add_to(s);
  u.add_to(s);
  EXPECT_EQ(umbra_volume(s.mesh(), cell), volume(hidden_by(t.points(), cell) + hidden_by(u.points(), cell)));
}

}  // namespace
}  // namespace clues::test
