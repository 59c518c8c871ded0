#include "refinement_judges.h"

#include <cmath>

#include "exact/complex/complex.h"
#include "exact/sight/point_occlusion.h"
#include "validate/visible_set/visible_set.h"

namespace clues::fastpath {

void judge_points(const scene::TriangleMesh& mesh, const std::vector<Point>& cell, const RefinedVisibility& found,
                  std::size_t most, Judged& judged) {
  const auto exact_cell = exact::ConvexCell::from_doubles(cell);
  std::vector<exact::TriangleCorners> corners;
  const Bvh bvh(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::binary_search(bvh.degenerate().begin(), bvh.degenerate().end(), t)) continue;
    const Corners c = bvh.corners(t);
    corners.push_back({exact::to_exact(c[0]), exact::to_exact(c[1]), exact::to_exact(c[2])});
  }
  for (const LocalRegion& r : found.first_order.regions) {
    if (r.visible || most == 0) continue;
    const Corners c = bvh.corners(r.triangle);
    // A side that faces away is hidden (D4), but points just off it are seen past its edges if the cell reaches up to its plane.
    const exact::Plane3 plane(exact::to_exact(c[0]), exact::to_exact(c[1]), exact::to_exact(c[2]));
    const auto in_front = r.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    const auto& s = exact_cell.vertices();
    if (std::none_of(s.begin(), s.end(), [&](const auto& v) { return plane.oriented_side(v) == in_front; })) continue;
    Point n{}, middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = (c[1][j] - c[0][j]) * (c[2][k] - c[0][k]) - (c[1][k] - c[0][k]) * (c[2][j] - c[0][j]);
      for (const Point& p : r.outline_estimate) middle[i] += p[i] / static_cast<double>(r.outline_estimate.size());
    }
    const double size = std::hypot(n[0], n[1], n[2]);
    const auto across = [&](const Point& a, const Point& b) {  // twice the area beside an edge
      Point x{};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = (a[j] - middle[j]) * (b[k] - middle[k]) - (a[k] - middle[k]) * (b[j] - middle[j]);
      }
      return std::hypot(x[0], x[1], x[2]);
    };
    bool small = false;
    for (std::size_t i = 0; i < r.outline_estimate.size(); ++i)
      small |= across(r.outline_estimate[i], r.outline_estimate[(i + 1) % r.outline_estimate.size()]) < 1e-4 * size;
    if (small) continue;
    for (std::size_t i = 0; i < 3; ++i) middle[i] += (r.front ? 1e-9 : -1e-9) * n[i] / std::sqrt(size);
    --most;
    ++judged.hidden_points;
    judged.seen_points += !exact::point_occlusion(exact::to_exact(middle), std::nullopt, exact_cell, corners).occluded;
  }
}

std::uint64_t lost(const Scene& s, const RefinedVisibility& found) {
  validate::VisibleSetOptions only;
  only.only = missing_from(found.first_order.visible, found.visible);
  const auto exact = validate::exact_visible_set(s.mesh, exact::ConvexCell::from_doubles(s.cell), only);
  return static_cast<std::uint64_t>(std::count_if(only.only.begin(), only.only.end(), [&](std::uint32_t t) {
    return exact.triangles[t].sight != validate::Sight::hidden;
  }));
}

}  // namespace clues::fastpath
