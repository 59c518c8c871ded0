// Corners (0, 1, g) and so on, g the golden ratio to the nearest double; each side is cut in two, twice: a direction in the middle of two is
// their sum, scaled to about the same length, so that the result is nearly the subdivision of the unit sphere. The lengths do not matter: a
// direction is a direction.
#include "fastpath/motion/base_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace clues::fastpath::motion {
namespace {

using scene::MotionPoint;
using Side = std::array<std::uint32_t, 3>;

double det(const MotionPoint& a, const MotionPoint& b, const MotionPoint& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double squared(const MotionPoint& a, const MotionPoint& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace

scene::DepthMesh icosahedral_base() {
  constexpr double golden = 0x1.9e3779b97f4a8p+0;
  std::vector<MotionPoint> points;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 4; ++signs) {
      MotionPoint p{};
      p[(axis + 1) % 3] = (signs & 1) != 0 ? -1 : 1;
      p[(axis + 2) % 3] = (signs & 2) != 0 ? -golden : golden;
      points.push_back(p);
    }
  }
  std::vector<Side> sides;
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        // The edges of this icosahedron have length 2, other distances are above 3.
        if (squared(points[a], points[b]) > 5 || squared(points[b], points[c]) > 5 || squared(points[c], points[a]) > 5)
          continue;
        sides.push_back(det(points[a], points[b], points[c]) > 0 ? Side{a, b, c} : Side{a, c, b});
      }
    }
  }
  const double radius = std::sqrt(1 + golden * golden);
  for (int level = 0; level < 2; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(points.size()));
      if (is_new) {
        MotionPoint m{points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2]};
        const double scale = radius / std::sqrt(squared(m, {0, 0, 0}));
        for (double& x : m) x *= scale;
        points.push_back(m);
      }
      return at->second;
    };
    std::vector<Side> next;
    for (const auto& [a, b, c] : sides) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sides = std::move(next);
  }
  scene::DepthMesh mesh;
  for (const MotionPoint& p : points) mesh.samples.push_back({p, true, true});
  mesh.triangles.assign(sides.begin(), sides.end());
  return mesh;
}

}  // namespace clues::fastpath::motion
