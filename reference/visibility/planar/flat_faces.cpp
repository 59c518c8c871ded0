#include "reference/visibility/planar/flat_faces.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>

#include <algorithm>
#include <utility>

#include "exact/complex/simple_point.h"
#include "scene/messages/error.h"

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point2;
using exact::Point3;

namespace {

// A short rational point inside triangle abc; `which` chooses among several.
Point2 inner_point(const Point2& a, const Point2& b, const Point2& c, std::size_t which) {
  const Point2 p =
      CGAL::barycenter(a, FT(3 + static_cast<int>(which) % 5), b, FT(4 + static_cast<int>(which) % 7), c, FT(5));
  const CGAL::Orientation o = CGAL::orientation(a, b, c);
  for (int level = 0; level < exact::kSimpleLevels; ++level) {
    const Point2 q(exact::simple_near(p.x(), level), exact::simple_near(p.y(), level));
    if (CGAL::orientation(a, b, q) == o && CGAL::orientation(b, c, q) == o && CGAL::orientation(c, a, q) == o) return q;
  }
  return p;
}

}  // namespace

bool inside(const std::vector<Ring2>& rings, const Point2& p) {
  bool odd = false;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const bool a_above = a.y() > p.y(), b_above = b.y() > p.y();
      if (a_above == b_above) continue;
      odd ^= CGAL::orientation(a, b, p) == (b_above ? CGAL::LEFT_TURN : CGAL::RIGHT_TURN);
    }
  }
  return odd;
}

FT twice_area(const Ring2& ring) {
  FT sum(0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

Ring2 without_spurs(Ring2 ring) {
  for (bool changed = true; changed && ring.size() >= 3;) {
    changed = false;
    for (std::size_t i = 0; i < ring.size() && ring.size() >= 3; ++i) {
      const std::size_t n = ring.size();
      if (ring[(i + n - 1) % n] == ring[(i + 1) % n]) {
        const std::size_t j = (i + 1) % n;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
        changed = true;
      }
    }
  }
  return ring;
}

bool on_outline(const Kernel::Triangle_2& triangle, const Point2& p, const Point2& q) {
  for (int k = 0; k < 3; ++k) {
    if (CGAL::collinear(triangle[k], triangle[k + 1], p) && CGAL::collinear(triangle[k], triangle[k + 1], q))
      return true;
  }
  return false;
}

Point2 inner_point(const std::vector<Ring2>& rings, std::size_t which) {
  if (rings.size() == 1 && rings[0].size() == 3) return inner_point(rings[0][0], rings[0][1], rings[0][2], which);
  using Tds = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                   CGAL::Constrained_triangulation_face_base_2<Kernel>>;
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds, CGAL::No_constraint_intersection_requiring_constructions_tag>
      cdt;
  for (const auto& ring : rings) cdt.insert_constraint(ring.begin(), ring.end(), true);
  std::vector<std::pair<FT, Point2>> by_size;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    const Point2 a = f->vertex(0)->point(), b = f->vertex(1)->point(), c = f->vertex(2)->point();
    const Point2 p = inner_point(a, b, c, which);
    if (inside(rings, p)) by_size.emplace_back(CGAL::abs(CGAL::area(a, b, c)), p);
  }
  if (by_size.empty()) throw scene::Error(scene::ErrorCode::internal, "regions: a face without an inner point");
  std::sort(by_size.begin(), by_size.end());
  return by_size[by_size.size() - 1 - which % by_size.size()].second;
}

TriangleFrame::TriangleFrame(const exact::Complex& complex, std::uint32_t piece)
    : plane_(complex.planes[piece]),
      frame_(plane_, complex.unit),
      corners_{complex.points[complex.pieces[piece].corners[0]], complex.points[complex.pieces[piece].corners[1]],
               complex.points[complex.pieces[piece].corners[2]]},
      flat_(frame_(corners_[0]), frame_(corners_[1]), frame_(corners_[2])) {}

TriangleFrame::TriangleFrame(const std::array<Point3, 3>& corners)
    : plane_(corners[0], corners[1], corners[2]),
      frame_(plane_),
      corners_(corners),
      flat_(frame_(corners_[0]), frame_(corners_[1]), frame_(corners_[2])) {}

}  // namespace clues::reference
