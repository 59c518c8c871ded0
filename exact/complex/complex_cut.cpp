// The exact steps behind D16: triangle-triangle contact, and the constrained triangulation of one plane.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exact/complex/complex_internal.h"

namespace clues::exact {
namespace {

using Tds = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                 CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds, CGAL::Exact_intersections_tag>>;

bool inside(const std::array<Point2, 3>& t, const Point2& p) {
  const CGAL::Orientation o = CGAL::orientation(t[0], t[1], t[2]);
  return CGAL::orientation(t[0], t[1], p) == o && CGAL::orientation(t[1], t[2], p) == o &&
         CGAL::orientation(t[2], t[0], p) == o;
}

}  // namespace

Point2 drop_axis(const Point3& p, int axis, double unit) {
  // A double stays one, where it does not leave their range.
  const auto in_units = [&](const FT& x) {
    if (unit == 1) return x;
    if (x.approx().is_point()) {
      const double given = x.approx().inf(), q = given / unit;
      if (q * unit == given) return FT(q);
    }
    return FT(x / unit);
  };
  return {in_units(p[(axis + 1) % 3]), in_units(p[(axis + 2) % 3])};
}

Point3 lift_axis(const Plane3& plane, const Point2& q, int axis, double unit) {
  using Rational = RationalKernel::FT;
  const RationalKernel::Plane_3& h = plane.exact();
  const Rational n[3] = {h.a(), h.b(), h.c()}, units(unit);
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  Rational x[3];
  x[u] = q.exact().x() * units;
  x[w] = q.exact().y() * units;
  x[axis] = -(n[u] * x[u] + n[w] * x[w] + h.d()) / n[axis];
  return to_lazy({x[0], x[1], x[2]});
}

int dominant_axis(const Vector3& normal) {
  int best = -1;
  double size = -1;
  for (int i = 0; i < 3; ++i) {
    const FT& c = normal[i];
    if (CGAL::is_zero(c)) continue;
    const double d = std::fabs(CGAL::to_double(c));
    if (d > size) {
      size = d;
      best = i;
    }
  }
  return best;
}

Contact meet(const Kernel::Triangle_3& a, const Kernel::Triangle_3& b) {
  Contact contact;
  if (!CGAL::do_intersect(a, b)) return contact;
  const auto result = CGAL::intersection(a, b);
  if (!result) return contact;
  if (const auto* p = boost::get<Point3>(&*result)) {
    contact.points = {*p};
  } else if (const auto* s = boost::get<Kernel::Segment_3>(&*result)) {
    contact.points = {s->source(), s->target()};
  } else if (const auto* t = boost::get<Kernel::Triangle_3>(&*result)) {
    contact.points = {t->vertex(0), t->vertex(1), t->vertex(2)};
    contact.overlap = true;
  } else if (const auto* polygon = boost::get<std::vector<Point3>>(&*result)) {
    contact.points = *polygon;
    contact.overlap = true;
  }
  return contact;
}

std::vector<CutFace> cut_in_plane(const std::vector<std::array<Point3, 3>>& triangles,
                                  const std::vector<Contact>& contacts) {
  const Plane3 plane(triangles[0][0], triangles[0][1], triangles[0][2]);
  const int axis = dominant_axis(plane.orthogonal_vector());
  std::vector<Point3> corners;
  for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  const double unit = unit_of(corners);
  const auto lay_flat = [&](const Point3& p) { return drop_axis(p, axis, unit); };
  const auto lift = [&](const Point2& q) { return lift_axis(plane, q, axis, unit); };

  Cdt cdt;
  std::map<Cdt::Vertex_handle, Point3> given;  // the vertices that are no crossings of constraints
  const auto insert = [&](const Point3& p, const Point2& q) {
    const Cdt::Vertex_handle vertex = cdt.insert(q);
    given.emplace(vertex, p);
    return vertex;
  };
  std::vector<std::array<Point2, 3>> flat;
  for (const auto& t : triangles) {
    flat.push_back({lay_flat(t[0]), lay_flat(t[1]), lay_flat(t[2])});
    const Cdt::Vertex_handle a = insert(t[0], flat.back()[0]), b = insert(t[1], flat.back()[1]);
    cdt.insert_constraint(a, b);
    const Cdt::Vertex_handle c = insert(t[2], flat.back()[2]);
    cdt.insert_constraint(b, c);
    cdt.insert_constraint(c, a);
  }
  for (const Contact& c : contacts) {
    const Cdt::Vertex_handle first = insert(c.points[0], lay_flat(c.points[0]));
    if (c.points.size() > 1) cdt.insert_constraint(first, insert(c.points[1], lay_flat(c.points[1])));
  }
  const auto corner_at = [&](Cdt::Vertex_handle vertex) {
    const auto it = given.find(vertex);
    return it != given.end() ? it->second : lift(vertex->point());
  };

  std::vector<CutFace> faces;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    const Point2 p[3] = {f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point()};
    const Point2 middle = CGAL::centroid(p[0], p[1], p[2]);
    CutFace face;
    for (std::size_t m = 0; m < flat.size(); ++m) {
      if (inside(flat[m], middle))
        face.owners.emplace_back(m, CGAL::orientation(flat[m][0], flat[m][1], flat[m][2]) == CGAL::LEFT_TURN);
    }
    if (face.owners.empty()) continue;
    face.corners = {corner_at(f->vertex(0)), corner_at(f->vertex(1)), corner_at(f->vertex(2))};
    if (!face.owners.front().second) {  // turn the face so that it looks like its first owner
      std::swap(face.corners[1], face.corners[2]);
      for (auto& owner : face.owners) owner.second = !owner.second;
    }
    faces.push_back(std::move(face));
  }
  // The triangulation's own order depends on its construction; give the faces one that depends on their corners only.
  for (CutFace& f : faces) {
    const auto least = std::min_element(f.corners.begin(), f.corners.end(), [](const Point3& a, const Point3& b) {
      return CGAL::lexicographically_xyz_smaller(a, b);
    });
    std::rotate(f.corners.begin(), least, f.corners.end());
  }
  std::sort(faces.begin(), faces.end(), [](const CutFace& a, const CutFace& b) {
    return std::lexicographical_compare(
        a.corners.begin(), a.corners.end(), b.corners.begin(), b.corners.end(),
        [](const Point3& x, const Point3& y) { return CGAL::lexicographically_xyz_smaller(x, y); });
  });
  return faces;
}

}  // namespace clues::exact
