// The points v whose segments to p meet one of the sets change where the line from p goes through a corner of a set, or where the border of a set crosses that of the
// polygon. Between two such places on an edge of the polygon one point answers for all, and for those of the polygon behind it: their segments go on from there.
// A set is an input triangle in the plane, or an edge or a corner with which one stands on it; a sight line that meets that comes to edges and corners of pieces, and crosses nothing
// cleanly. What goes through the plane is no such set. Of a part of a complex there is a set for each piece instead: what is missing of a triangle leaves gaps.
#include "reference/visibility/labels/special_position.h"

#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Projection_traits_xz_3.h>
#include <CGAL/Projection_traits_yz_3.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "exact/cell/cell_plane.h"

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Plane3;
using exact::Point3;

namespace {

std::vector<Point3> hull_in(const Plane3& plane, const std::vector<Point3>& points) {
  std::vector<Point3> hull;
  const auto of = [&](const auto& traits) {
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull), traits);
  };
  if (!CGAL::is_zero(plane.c())) {
    of(CGAL::Projection_traits_xy_3<Kernel>());
  } else if (!CGAL::is_zero(plane.b())) {
    of(CGAL::Projection_traits_xz_3<Kernel>());
  } else {
    of(CGAL::Projection_traits_yz_3<Kernel>());
  }
  return hull;
}

}  // namespace

SpecialPosition::SpecialPosition(const exact::SceneQuery& scene, const Plane3& plane)
    : normal_(plane.orthogonal_vector()) {
  const exact::Complex& complex = scene.complex();
  struct Part {                         // of the scene: an input triangle, or a piece
    bool above = false, below = false;  // what of it touches the plane has corners there
    std::uint32_t piece = 0;
    std::set<std::uint32_t> on;  // points
  };
  std::map<std::uint32_t, Part> parts;
  const auto add = [&](std::uint32_t name, std::uint32_t t) {
    Part& of = parts[name];
    of.piece = t;
    for (const std::uint32_t i : complex.pieces[t].corners) {
      const auto side = plane.oriented_side(complex.points[i]);
      of.above |= side == CGAL::ON_POSITIVE_SIDE;
      of.below |= side == CGAL::ON_NEGATIVE_SIDE;
      if (side == CGAL::ON_ORIENTED_BOUNDARY) of.on.insert(i);
    }
  };
  for (const std::uint32_t t : scene.candidates(exact::PlaneBoxTest(plane))) {
    if (!scene.is_whole()) {
      add(t, t);
    } else {
      for (const exact::Origin& origin : complex.pieces[t].origins) add(origin.triangle, t);
    }
  }
  for (const auto& [name, of] : parts) {
    if (of.on.empty() || (of.above && of.below)) continue;
    std::vector<Point3> points;
    for (const std::uint32_t i : of.on) points.push_back(complex.points[i]);
    const Plane3& own = complex.planes[of.piece];
    sets_.push_back({hull_in(plane, points), own, !of.above && !of.below, exact::lies_in(scene.cell(), own)});
  }
}

bool SpecialPosition::meets(const Set& set, const Point3& v, const Point3& p) {
  const Kernel::Segment_3 line(v, p);
  const auto& c = set.corners;
  if (c.size() == 1) return line.has_on(c[0]);
  if (c.size() == 2) return CGAL::do_intersect(line, Kernel::Segment_3(c[0], c[1]));
  return CGAL::do_intersect(line, Kernel::Triangle_3(c[0], c[1], c[2]));
}

std::optional<Point3> SpecialPosition::free_viewpoint(const std::vector<Point3>& viewpoints, const Point3& p,
                                                      bool off_planes) const {
  std::vector<const Set*> sets;
  for (const Set& set : sets_) {
    // A sight line that ends in the plane of what stands there is not special for it, nor is one that leaves that plane.
    if (set.in_plane ? !off_planes : !set.holds_cell && !set.of_piece.has_on(p)) sets.push_back(&set);
  }
  const auto crossing = [&](const Point3& x, const Point3& y, const Point3& a, const Point3& b) -> std::optional<FT> {
    const auto side = [&](const Point3& q) { return FT(normal_ * CGAL::cross_product(y - x, q - x)); };
    const FT at_a = side(a), at_b = side(b);
    if (CGAL::sign(at_a) * CGAL::sign(at_b) >= 0) return std::nullopt;
    return FT(at_a / (at_a - at_b));
  };
  for (std::size_t i = 0; i < viewpoints.size(); ++i) {
    const Point3 &a = viewpoints[i], &b = viewpoints[(i + 1) % viewpoints.size()];
    std::vector<FT> places{FT(0), FT(1)};
    const auto note = [&](const std::optional<FT>& t) {
      if (t) places.push_back(*t);
    };
    for (const Set* set : sets) {
      const auto& c = set->corners;
      for (std::size_t k = 0; k < c.size(); ++k) {
        note(crossing(p, c[k], a, b));
        if (c.size() > 1) note(crossing(c[k], c[(k + 1) % c.size()], a, b));
      }
    }
    std::sort(places.begin(), places.end());
    for (std::size_t k = 1; k < places.size(); ++k) {
      if (places[k - 1] == places[k]) continue;
      const Point3 v = a + (places[k - 1] + places[k]) / FT(2) * (b - a);
      if (std::none_of(sets.begin(), sets.end(), [&](const Set* set) { return meets(*set, v, p); })) return v;
    }
  }
  return std::nullopt;
}

}  // namespace clues::reference
