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

// A-4 with its numbers, drawn out along z: the cell is the strip x = 0, -4 <= y <= 0; a plate ends in the edge E at (10, 0); a small plate O at x = 8 hides
// y > -1 from E. The adjusted wedge is y = (x - 10) / 10; the point (100, 8.9) is below it, and is seen from (0, 0).
struct HazardA4 : Scene {
  std::uint32_t target, near_target;
  HazardA4() {
    quad({10, -50, -64}, {10, 0, -64}, {10, 0, 64}, {10, -50, 64});
    quad({8, -0.2, -64}, {8, 0.2, -64}, {8, 0.2, 64}, {8, -0.2, 64});
    target = quad({100, 8.75, -1}, {100, 8.9375, -1}, {100, 8.9375, 1}, {100, 8.75, 1});
    near_target = quad({12, 0.0625, -1}, {12, 0.125, -1}, {12, 0.125, 1}, {12, 0.0625, 1});
    cell = {{0, -4, -1}, {0, 0, -1}, {0, 0, 1}, {0, -4, 1}};
  }
};

}  // namespace clues::fastpath
