#include "reference/visibility/wedges/apex.h"

#include <algorithm>

#include "exact/cell/cell_plane.h"
#include "reference/visibility/wedges/anticone.h"

namespace clues::reference {

using exact::FT;
using exact::Point3;
using exact::Vector3;

Apex Apex::at_vertex(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t point,
                     const std::vector<exact::Plane3>& contours) {
  Apex apex(cell, complex.points[point], LocalStar::around_vertex(complex, point));
  apex.id_ = point;
  if (!apex.flat_) apex.add_circles(contours, cell);
  return apex;
}

void Apex::add_circles(const std::vector<exact::Plane3>& contours, const exact::ConvexCell& cell) {
  const auto add = [&](const exact::Plane3& plane) {
    const Vector3 n = plane.orthogonal_vector();
    const auto is_it = [&](const Circle& c) { return same_direction(c.normal, n); };
    if (!exact::lies_in(cell, plane) && star_.meets_circle(n) && std::none_of(circles_.begin(), circles_.end(), is_it))
      circles_.push_back({n, std::nullopt, {}, {}});
  };
  if (sectors_.empty()) return;
  for (const exact::Plane3& plane : contours) add(plane);
  for (const ApexSector& s : sectors_) add(s.plane);
}

Apex Apex::at_edge(const exact::Complex& complex, const exact::ConvexCell& cell, std::uint32_t edge, const Point3& x) {
  Apex apex(cell, x, LocalStar::around_edge_point(complex, edge, x));
  apex.on_edge_ = true;
  apex.id_ = edge;
  apex.generation = -1;
  return apex;
}

Apex::Apex(const exact::ConvexCell& cell, const Point3& x, LocalStar star) : x_(x), star_(std::move(star)) {
  for (const Point3& s : cell.vertices()) anticone_.push_back(x - s);
  for (const AnticoneFacet& f : anticone_facets(x, cell)) {
    if (exact::lies_in(cell, f.plane)) {
      flat_ = true;
      sectors_.push_back({f.plane, f.ray0, f.ray1, {}, {}, {}, nullptr, false});
      continue;
    }
    const Vector3 n = f.plane.orthogonal_vector(), inwards = x - cell.center();
    const auto turns_left = [&](const Vector3& u, const Vector3& w) {
      return CGAL::is_positive(n * CGAL::cross_product(u, w));
    };
    std::vector<Vector3> rays{f.ray0};
    for (const Vector3& t : star_.traces(n)) {
      if (turns_left(f.ray0, t) && turns_left(t, f.ray1)) rays.push_back(t);
    }
    std::sort(rays.begin() + 1, rays.end(), turns_left);
    rays.push_back(f.ray1);
    for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
      if (!turns_left(rays[i], rays[i + 1])) continue;
      const auto size = [](const Vector3& v) { return CGAL::abs(v.x()) + CGAL::abs(v.y()) + CGAL::abs(v.z()); };
      const Vector3 middle = rays[i] / size(rays[i]) + rays[i + 1] / size(rays[i + 1]);
      const Vector3 inner = star_.nudged(middle, inwards);
      sectors_.push_back({f.plane, rays[i], rays[i + 1], middle, inner, star_.face_of(inner), nullptr, false});
    }
  }
}

Probe Apex::probe(const Vector3& limit, const Vector3& aside, const Vector3& off) const {
  if (flat_) return {{limit, aside, off}, limit, CGAL::NULL_VECTOR};
  const Vector3 actual = aside == CGAL::NULL_VECTOR ? star_.nudged(limit, off) : star_.nudged(limit, aside, off);
  return {{limit, aside == CGAL::NULL_VECTOR ? off : aside, off}, actual, CGAL::NULL_VECTOR, false};
}

bool Apex::spreads(const Probe& p, std::size_t k, std::vector<Face>& faces) {
  const ApexSector& s = sectors_[k];
  if (on_edge_) return star_.spreads_around_edge(p.beside, s.inner, anticone_);
  return circles_.empty() || star_.free_between(p.beside, s.inner) || passes_circles(p, k, faces);
}

// T13. Let h be a plane through x with int V strictly in H+. Light gets next to x in directions into int V, which are in H+, and there its legs, being parts of rays from
// H+, cross the circle of h from H+ to H- alone, and where no piece is. The inside of a sector is in H-. So a free part of the circle lies between the face of such directions and that of
// the sector; and light that was in H- before stays in one face with it. This must hold for every h; here it is asked of some.
bool Apex::passes_circles(const Probe& p, std::size_t k, std::vector<Face>& faces) {
  faces.resize(circles_.size());
  for (std::size_t i = 0; i < circles_.size(); ++i) {
    Circle& c = circles_[i];
    const CGAL::Sign side = side_of(c.normal, p.beside);
    if (side == CGAL::ZERO) continue;
    if (!c.star) {
      c.star = star_.with_circle(c.normal);
      c.across = c.star->across_circle();
      c.inside.resize(sectors_.size());
    }
    if (faces[i].empty()) faces[i] = c.star->face_of(c.star->nudged(p.beside.limit, p.beside.aside, p.beside.off));
    if (c.inside[k].empty()) c.inside[k] = c.star->face_of(sectors_[k].inner);
    const Face &from = faces[i], &to = c.inside[k];
    const bool passes = side == CGAL::POSITIVE
                            ? from == to
                            : std::find(c.across.begin(), c.across.end(), std::pair(from, to)) != c.across.end();
    if (!passes) return false;
  }
  return true;
}

std::vector<Vector3> Apex::into_cell(const exact::ConvexCell& cell, const std::vector<Vector3>& known) const {
  std::vector<Vector3> found;
  if (sectors_.empty()) return found;
  if (flat_) return star_.into_cell(x_, cell);
  std::vector<Vector3> reached = known;
  for (const Vector3& d : star_.into_cell(x_, cell)) {
    if (!has_sector_in(star_.face_of(d))) continue;
    if (std::any_of(reached.begin(), reached.end(), [&](const Vector3& r) { return in_one_part(r, d); })) continue;
    reached.push_back(d);
    found.push_back(d);
  }
  return found;
}

bool Apex::has_sector_in(const std::vector<int>& face) const {
  return std::any_of(sectors_.begin(), sectors_.end(), [&](const ApexSector& s) { return s.face == face; });
}

bool Apex::has_sector_facing(const Vector3& d) const {
  return !sectors_.empty() && (flat_ || has_sector_in(star_.face_of(d)));
}

void Apex::start_round() {
  probes_.clear();
  fresh_ = false;
  generation = on_edge_ ? -1 : 0;
  for (ApexSector& s : sectors_) s.built = false;
}

std::vector<std::size_t> Apex::new_sectors() {
  std::vector<std::size_t> found;
  if (!fresh_) return found;
  fresh_ = false;
  std::vector<std::vector<int>> faces;
  if (!flat_) {
    for (const Probe& p : probes_) faces.push_back(star_.face_of(p.actual));
  }
  std::vector<std::vector<Face>> faces_with_circles(probes_.size());
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    ApexSector& s = sectors_[i];
    if (s.built) continue;
    if (flat_) {
      s.built = true;
      found.push_back(i);
      continue;
    }
    const Vector3 n = s.plane.orthogonal_vector();
    bool exists = false, bounds_nothing = false;
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      const Probe& p = probes_[k];
      const bool spreads_here = faces[k] == s.face && spreads(p, i, faces_with_circles[k]);
      exists |= spreads_here;
      // Visible space strictly in H+ that surely reaches the points just off `middle` in H+ too. A point of the visible part of a
      // crossed edge reaches whatever its own face allows.
      if (p.doubtful) continue;
      bounds_nothing |= (p.lit_edge != CGAL::NULL_VECTOR && spreads_here && CGAL::is_negative(n * p.lit_edge)) ||
                        (CGAL::is_negative(n * p.beside.limit) && star_.free_between(p.beside, s.middle));
    }
    if (!exists) continue;
    if (bounds_nothing) continue;
    s.built = true;
    found.push_back(i);
  }
  return found;
}

}  // namespace clues::reference
