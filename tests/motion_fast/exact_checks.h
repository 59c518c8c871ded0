// What the tests of the walk judge by: exact/motion/ alone, with topology of their own.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "exact/motion/constraints.h"
#include "fuzz/generators/random.h"
#include "scene/mesh/mesh.h"
#include "scene/motion/depth_mesh.h"

namespace clues::tests {

using scene::DepthMesh;
using scene::DepthSample;
using scene::MotionPoint;
using scene::MotionThresholds;

inline double uniform(fuzz::Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.next() >> 11U) * 0x1p-53;
}

inline MotionPoint point_in_ball(fuzz::Random& random) {
  for (;;) {
    const MotionPoint p{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    if (square <= 1 && square > 0.01) return p;
  }
}

// Of length 1, nearly.
inline MotionPoint direction(fuzz::Random& random) {
  MotionPoint p = point_in_ball(random);
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (double& x : p) x /= length;
  return p;
}

// What is wrong with a mesh at a viewpoint, empty when nothing is: an edge without two triangles, a triangle that fails, an edge that is not
// locally Delaunay where it has to be.
inline std::string fault_of(const DepthMesh& mesh, const MotionPoint& at, const MotionThresholds& thresholds) {
  const exact::ExactThresholds limits(thresholds);
  std::vector<exact::SightRow> rows;
  for (const DepthSample& s : mesh.samples) rows.push_back(exact::sight_row(s, at));
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> opposite;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!opposite.emplace(std::array{t[(i + 1) % 3], t[(i + 2) % 3]}, t[i]).second)
        return "an edge has two triangles on one side";
    }
  }
  if (mesh.triangles.size() != 2 * mesh.samples.size() - 4) return "no sphere";
  for (const auto& t : mesh.triangles) {
    const auto &a = rows[t[0]], &b = rows[t[1]], &c = rows[t[2]];
    if (exact::facing_sign(a, b, c) <= 0) return "a triangle does not face the viewpoint";
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &p = rows[t[i]], &q = rows[t[(i + 1) % 3]], &r = rows[t[(i + 2) % 3]];
      if (!exact::edge_length_holds(p, q, limits)) return "an edge is too short";
      if (!exact::separation_holds(p, q, r, limits)) return "a vertex is too near to an edge";
      const auto other = opposite.find({t[(i + 2) % 3], t[(i + 1) % 3]});
      if (other == opposite.end()) return "an edge has one triangle";
      if (thresholds.delaunay && exact::delaunay_sign(p, q, r, rows[other->second]) < 0)
        return "an edge is not Delaunay";
    }
  }
  return {};
}

// A box room around the origin with a few boxes in it; z is up.
inline scene::TriangleMesh room() {
  scene::TriangleMesh mesh;
  const auto box = [&](const MotionPoint& low, const MotionPoint& high) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (unsigned i = 0; i < 8; ++i) {
      mesh.points.push_back(
          {(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1], (i & 4U) != 0 ? high[2] : low[2]});
    }
    constexpr std::array<scene::Triangle, 12> sides{{{0, 2, 1},
                                                     {1, 2, 3},
                                                     {4, 5, 6},
                                                     {5, 7, 6},
                                                     {0, 1, 4},
                                                     {1, 5, 4},
                                                     {2, 6, 3},
                                                     {3, 6, 7},
                                                     {0, 4, 2},
                                                     {2, 4, 6},
                                                     {1, 3, 5},
                                                     {3, 7, 5}}};
    for (const auto& [a, b, c] : sides) mesh.triangles.push_back({first + a, first + b, first + c});
  };
  box({-5, -4, -1.5}, {5, 4, 2});
  box({1, 1, -1.5}, {2, 2, 0.5});
  box({-3, 1.25, -1.5}, {-2, 2.5, 1});
  box({-1.5, -3, -0.5}, {0.25, -2, 0});
  return mesh;
}

}  // namespace clues::tests
