// D12 by exact plane sides.
#include "reference/visibility/wedges/anticone.h"

#include <algorithm>
#include <utility>

namespace clues::reference {

using exact::Point3;
using exact::Vector3;

namespace {

// The sectors of a plane that holds a facet of V (or all of a flat V) in which x looks away from that facet: the directions from its points to x, corner by corner, so that
// each sector is less than a half turn.
void add_sectors(const Point3& x, const exact::ConvexCell& cell, const exact::CellFacet& f,
                 std::vector<AnticoneFacet>& facets) {
  std::vector<Vector3> rays;
  for (const int c : f.corners) {
    const Vector3 away = x - cell.vertices()[static_cast<std::size_t>(c)];
    if (away != CGAL::NULL_VECTOR) rays.push_back(away);
  }
  const Vector3 n = f.plane.orthogonal_vector();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vector3 &a = rays[i], &b = rays[(i + 1) % rays.size()];
    if (CGAL::is_positive(n * CGAL::cross_product(a, b))) facets.push_back({f.plane, a, b});
  }
}

// x on the border of V: A(x) is the cone opposite to V at x. That of a solid cell is bounded by the planes of the facets at x. That of a polygon is flat, and bounded by either side
// of the cell's plane. A segment's is a ray, and bounds nothing.
std::vector<AnticoneFacet> facets_on_border(const Point3& x, const exact::ConvexCell& cell) {
  std::vector<AnticoneFacet> facets;
  for (const exact::CellFacet& f : cell.facets()) {
    if (f.plane.has_on(x)) add_sectors(x, cell, f, facets);
  }
  if (cell.dimension() == 2) {
    for (std::size_t i = 0, n = facets.size(); i < n; ++i)
      facets.push_back({facets[i].plane.opposite(), facets[i].ray1, facets[i].ray0});
  }
  return facets;
}

}  // namespace

std::vector<AnticoneFacet> anticone_facets(const Point3& x, const exact::ConvexCell& cell) {
  std::vector<AnticoneFacet> facets;
  if (cell.contains(x)) {
    if (!cell.interior_contains(x)) return facets_on_border(x, cell);
    return facets;
  }
  const std::vector<Point3>& s = cell.vertices();
  std::vector<std::vector<int>> seen;  // touching sets already used: a cell facet seen edge-on is met once per edge
  for (const auto& [i, j] : cell.edges()) {
    const Point3 &p = s[static_cast<std::size_t>(i)], &q = s[static_cast<std::size_t>(j)];
    if (CGAL::collinear(x, p, q)) continue;
    std::vector<int> touching;
    bool above = false, below = false;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const CGAL::Orientation o = CGAL::orientation(x, p, q, s[k]);
      above |= o == CGAL::POSITIVE;
      below |= o == CGAL::NEGATIVE;
      if (o == CGAL::COPLANAR) touching.push_back(static_cast<int>(k));
    }
    if (above && below) continue;
    if (std::find(seen.begin(), seen.end(), touching) != seen.end()) continue;
    seen.push_back(touching);
    // Plane3(x, p, q) has its positive side where orientation(x, p, q, .) is positive.
    std::vector<exact::Plane3> planes;
    if (!above) planes.emplace_back(x, p, q);
    if (!below) planes.emplace_back(x, q, p);
    for (const exact::Plane3& plane : planes) {
      // The extreme rays among the touching vertices; they span less than a half turn, because x is not in V.
      const Vector3 n = plane.orthogonal_vector();
      const auto turns_left = [&](const Vector3& u, const Vector3& w) {
        return CGAL::is_positive(n * CGAL::cross_product(u, w));
      };
      Vector3 first = x - s[static_cast<std::size_t>(touching.front())], last = first;
      for (const int k : touching) {
        const Vector3 w = x - s[static_cast<std::size_t>(k)];
        if (turns_left(w, first)) first = w;
        if (turns_left(last, w)) last = w;
      }
      facets.push_back({plane, first, last});
    }
  }
  return facets;
}

void LeftOut::add(const Point3& x, const exact::ConvexCell& cell) {
  std::vector<exact::Plane3>& planes = anticones_.emplace_back();
  for (const AnticoneFacet& f : anticone_facets(x, cell)) planes.push_back(f.plane);
}

// Let n x >= c hold at both ends, and n s <= c for all s in V: then it holds for each point between the ends, and for what is in its anti-cone.
void LeftOut::add(const Point3& lo, const Point3& hi, const exact::Plane3& supporting, const exact::ConvexCell& cell) {
  std::vector<exact::Plane3>& planes = anticones_.emplace_back(1, supporting);
  for (const auto& [x, other] : {std::pair(lo, hi), std::pair(hi, lo)}) {
    for (const AnticoneFacet& f : anticone_facets(x, cell)) {
      if (f.plane.oriented_side(other) != CGAL::ON_NEGATIVE_SIDE) planes.push_back(f.plane);
    }
  }
}

// If the segment enters one side no later than it leaves every other.
bool LeftOut::meets(std::size_t i, const Point3& a, const Point3& b) const {
  exact::FT enters(0), leaves(1);
  for (const exact::Plane3& h : anticones_[i]) {
    const exact::FT at_a = h.a() * a.x() + h.b() * a.y() + h.c() * a.z() + h.d(),
                    at_b = h.a() * b.x() + h.b() * b.y() + h.c() * b.z() + h.d();
    const bool from_outside = CGAL::is_negative(at_a), to_outside = CGAL::is_negative(at_b);
    if (from_outside && to_outside) return false;
    if (from_outside) enters = std::max(enters, exact::FT(at_a / (at_a - at_b)));
    if (to_outside) leaves = std::min(leaves, exact::FT(at_a / (at_a - at_b)));
  }
  return enters <= leaves;
}

bool LeftOut::holds(std::size_t i, const Point3& x) const {
  return std::none_of(anticones_[i].begin(), anticones_[i].end(),
                      [&](const exact::Plane3& h) { return h.oriented_side(x) == CGAL::ON_NEGATIVE_SIDE; });
}

bool LeftOut::may_reach(const std::vector<Point3>& corners) const {
  const auto keeps_out = [&](const exact::Plane3& h) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point3& q) { return h.oriented_side(q) == CGAL::ON_NEGATIVE_SIDE; });
  };
  return std::any_of(anticones_.begin(), anticones_.end(), [&](const std::vector<exact::Plane3>& facets) {
    return std::none_of(facets.begin(), facets.end(), keeps_out);
  });
}

}  // namespace clues::reference
