#include "reference/visibility/refinement/exactness.h"

#include <CGAL/intersections.h>

#include <algorithm>

namespace clues::reference {

using exact::FT;
using exact::Kernel;
using exact::Point3;
using exact::Vector3;

namespace {

// The corners of what two triangles have in common.
std::vector<Point3> common(const Kernel::Triangle_3& a, const Kernel::Triangle_3& b) {
  if (!CGAL::do_intersect(a, b)) return {};
  const auto met = CGAL::intersection(a, b);
  if (!met) return {};
  if (const auto* p = boost::get<Point3>(&*met)) return {*p};
  if (const auto* s = boost::get<Kernel::Segment_3>(&*met)) return {s->source(), s->target()};
  if (const auto* t = boost::get<Kernel::Triangle_3>(&*met)) return {(*t)[0], (*t)[1], (*t)[2]};
  return boost::get<std::vector<Point3>>(*met);
}

struct InTriangle {  // proposes occluders by their boxes
  CGAL::Bbox_3 box;
  bool operator()(const CGAL::Bbox_3& other) const { return CGAL::do_overlap(box, other); }
};

Kernel::Triangle_3 corners_of(const exact::Complex& complex, std::uint32_t t) {
  const auto& c = complex.pieces[t].corners;
  return {complex.points[c[0]], complex.points[c[1]], complex.points[c[2]]};
}

}  // namespace

std::vector<Portion> portions(const exact::SceneQuery& scene, const Wedge& wedge) {
  const Point3& c = wedge.center;
  const Vector3 n = wedge.plane.orthogonal_vector();
  // Where the ray from c through x meets the near line: 0 at near0, 1 at near1.
  const auto at = [&](const Point3& x) {
    const FT a = n * CGAL::cross_product(wedge.near0 - c, x - c), b = n * CGAL::cross_product(wedge.near1 - c, x - c);
    return exact::collapsed(a / (a - b));
  };
  const auto point = [&](const FT& t) { return exact::collapsed(wedge.near0 + t * (wedge.near1 - wedge.near0)); };
  FT lo = at(wedge.on_ray0), hi = at(wedge.on_ray1);
  if (hi < lo) std::swap(lo, hi);
  const Point3 y0 = point(lo), y1 = point(hi);
  const Kernel::Triangle_3 supporting(c, y0, y1);
  std::vector<std::pair<FT, FT>> shadows;
  for (const std::uint32_t t : scene.candidates(InTriangle{supporting.bbox()})) {
    const std::vector<Point3> met = common(supporting, corners_of(scene.complex(), t));
    if (std::all_of(met.begin(), met.end(), [&](const Point3& x) { return CGAL::collinear(y0, y1, x); })) continue;
    if (std::find(met.begin(), met.end(), c) != met.end()) return {{y0, y1, false}};
    FT from = hi, to = lo;
    for (const Point3& x : met) {
      const FT s = at(x);
      from = std::min(from, s);
      to = std::max(to, s);
    }
    if (from < to) shadows.emplace_back(from, to);
  }
  std::sort(shadows.begin(), shadows.end());
  std::vector<Portion> out;
  FT reached = lo;
  for (std::size_t i = 0; i < shadows.size();) {
    const FT from = std::max(shadows[i].first, reached);
    FT to = shadows[i].second;
    for (++i; i < shadows.size() && shadows[i].first <= to; ++i) to = std::max(to, shadows[i].second);
    if (reached < from) out.push_back({point(reached), point(from), true});
    out.push_back({point(from), point(to), false});
    reached = to;
  }
  if (reached < hi) out.push_back({point(reached), point(hi), true});
  return out;
}

}  // namespace clues::reference
