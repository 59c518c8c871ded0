#include "strip_scenes.h"

#include <algorithm>
#include <stdexcept>

namespace clues::test {

using exact::ConvexCell;
using exact::FT;
using exact::Plane3;
using exact::Point3;
using reference::ContourSegment;

std::uint32_t edge_between(const exact::Complex& complex, const Point3& a, const Point3& b) {
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const Point3 &p = complex.points[complex.edges[e].a], &q = complex.points[complex.edges[e].b];
    if ((p == a && q == b) || (p == b && q == a)) return e;
  }
  throw std::runtime_error("no such edge");
}

const ConvexCell kStrip = ConvexCell::from_doubles({{0, -4, -1}, {0, 0, -1}, {0, 0, 1}, {0, -4, 1}});
SceneBuilder plate_below() {
  SceneBuilder scene;
  scene.quad({10, -50, -64}, {10, 0, -64}, {10, 0, 64}, {10, -50, 64});
  return scene;
}
ContourSegment segment_at_ten(const exact::Complex& complex) {
  const Point3 lo(10, 0, -64), hi(10, 0, 64);
  return {edge_between(complex, lo, hi), lo, hi, Plane3(0, 1, 0, 0), Point3(0, 0, -1)};
}

ContourSegment segment(const Point3& lo, const Point3& hi) { return {0, lo, hi, Plane3(0, 1, 0, 0), lo}; }

FT lowest_y(const std::vector<Point3>& points) {
  return std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); })
      ->y();
}
FT highest_y(const std::vector<Point3>& points) {
  return std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); })
      ->y();
}

}  // namespace clues::test
