// What the tests of refinement share: scenes of plates and slits, and lists of triangles.
#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

#include "fastpath/visibility/refinement/refinement.h"

namespace clues::fastpath {

using Ids = std::vector<std::uint32_t>;

struct Scene {
  scene::TriangleMesh mesh;
  std::vector<Point> cell;

  std::uint32_t quad(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Point& p : {a, b, c, d}) mesh.points.push_back(p);
    const auto t = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.face_of.assign(mesh.triangles.size(), 0);
    std::iota(mesh.face_of.begin(), mesh.face_of.end(), 0U);
    return t;
  }
  std::uint32_t plate(double x0, double y0, double x1, double y1, double z) {
    return quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
  }
  // Covers n . x >= g at height z, as far as 8; n has entries -1, 0, 1.
  void half_plane(double nx, double ny, double g, double z) {
    constexpr double r = 8;
    const double s = nx * nx + ny * ny, x = nx * g / s, y = ny * g / s;
    quad({x + r * ny, y - r * nx, z}, {x + r * (ny + nx), y + r * (ny - nx), z},
         {x + r * (nx - ny), y + r * (ny + nx), z}, {x - r * ny, y + r * nx, z});
  }
};

inline std::vector<Point> box(const Point& lo, const Point& hi) {
  std::vector<Point> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({i & 1U ? hi[0] : lo[0], i & 2U ? hi[1] : lo[1], i & 4U ? hi[2] : lo[2]});
  return corners;
}

inline RefinedVisibility refine(const scene::TriangleMesh& mesh, const std::vector<Point>& cell,
                                const RefinementOptions& refinement) {
  const Bvh bvh(mesh);
  return refined_visibility(bvh, cell, {}, refinement);
}

inline bool lists(const Ids& ids, std::uint32_t t) { return std::binary_search(ids.begin(), ids.end(), t); }

inline Ids missing_from(const Ids& all, const Ids& some) {
  Ids out;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(out));
  return out;
}

// Two slits that cross each other at an angle, in two walls, and behind them a floor of tiles.
inline Scene slits_and_tiles() {
  Scene s;
  s.half_plane(0, 1, 1 / 8., 2);
  s.half_plane(0, -1, 1 / 8., 2);
  s.half_plane(1, 1, 1 / 8., 4);
  s.half_plane(-1, -1, 1 / 8., 4);
  for (int x = -4; x < 4; ++x) {
    for (int y = -4; y < 4; ++y) s.plate(x, y, x + 1, y + 1, 6);
  }
  s.cell = box({-1, -1, 0}, {1, 1, 0.5});
  return s;
}

}  // namespace clues::fastpath
