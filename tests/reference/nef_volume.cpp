#include "tests/reference/nef_volume.h"

#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/mpq_class.h>

namespace clues::test {
namespace {

using Kernel = CGAL::Simple_cartesian<mpq_class>;
using Point = Kernel::Point_3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Nef hull(const std::vector<Point>& points) {
  Polyhedron p;
  CGAL::convex_hull_3(points.begin(), points.end(), p);
  return Nef(p);
}

mpq_class volume(const Nef& nef) {
  Polyhedron p;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(nef, p, true);
  mpq_class six = 0;
  for (auto f = p.facets_begin(); f != p.facets_end(); ++f) {
    auto h = f->facet_begin();
    const Point a = (h++)->vertex()->point(), b = (h++)->vertex()->point(), c = h->vertex()->point();
    six += CGAL::determinant(a - CGAL::ORIGIN, b - CGAL::ORIGIN, c - CGAL::ORIGIN);
  }
  return six / 6;
}

Nef bounds() {
  std::vector<Point> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 6 : -6, i & 2 ? 6 : -6, i & 4 ? 6 : -1);
  return hull(corners);
}

Point to_point(const Corner& c) { return {c[0], c[1], c[2]}; }

// The intersection of its shadows.
Nef hidden_by(const std::vector<Corner>& blocker, const std::vector<Corner>& cell) {
  Nef hidden = bounds();
  for (const Corner& v : cell) {
    std::vector<Point> shadow;
    for (const Corner& k : blocker) {
      shadow.push_back(to_point(k));
      shadow.push_back(to_point(k) + 40 * (to_point(k) - to_point(v)));
    }
    hidden = hidden * hull(shadow);
  }
  return hidden;
}

}  // namespace

mpq_class hidden_volume(const std::vector<std::vector<Corner>>& blockers, const std::vector<Corner>& cell) {
  Nef hidden(Nef::EMPTY);
  for (const auto& blocker : blockers) hidden = hidden + hidden_by(blocker, cell);
  return volume(hidden);
}

}  // namespace clues::test
