// Scenes in which the exact visible set needs every one of its questions.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "exact/cell/convex_cell.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/mesh/mesh.h"
#include "validate/visible_set/visible_set.h"

namespace clues::validate::tests {

struct SightMesh : scene::TriangleMesh {
  std::uint32_t triangle(const scene::Point& a, const scene::Point& b, const scene::Point& c) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
    face_of.push_back(static_cast<std::uint32_t>(face_of.size()));
    return static_cast<std::uint32_t>(triangles.size()) - 1;
  }
  void quad(const scene::Point& a, const scene::Point& b, const scene::Point& c, const scene::Point& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
};

// What the exact visible set says of it; where that is visible, with a sight line.
inline Sight sight_of(const scene::TriangleMesh& mesh, std::uint32_t triangle, const exact::ConvexCell& cell,
                      bool trust_map = false) {
  VisibleSetOptions options;
  options.trust_map = trust_map;
  const auto set = exact_visible_set(mesh, cell, options);
  EXPECT_EQ(set.triangles.at(triangle).witness.has_value(), set.triangles[triangle].sight == Sight::visible);
  return set.triangles[triangle].sight;
}

inline exact::ConvexCell box(double x, double y, double z0, double z1) {
  std::vector<scene::Point> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z1 : z0});
  return exact::ConvexCell::from_doubles(corners);
}

// The target is seen through a hole that opens and closes where three shadows meet, and at no sampled point.
struct HoleBetweenShadows {
  fuzz::GeneratedScene scene = fuzz::generate(fuzz::Kind::interpenetrating, 20261121, 11);
  exact::ConvexCell cell = exact::ConvexCell::from_doubles(scene.cell);
  std::uint32_t target = 11;
};

// Only lines that come steeply from the left reach the cell, and each hits a plate after it has left the cell again.
struct PlateBehindTheCell {
  SightMesh mesh;
  exact::ConvexCell cell = box(.5, .5, -1, 0);
  std::uint32_t target;
  PlateBehindTheCell() {
    target = mesh.triangle({-6, -1, 6}, {6, -1, 6}, {-6, 1, 6});
    mesh.quad({-1, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-1, 9, 1});
    mesh.quad({1.5, -9, .75}, {1.5, 9, .75}, {-.5, 9, -2.875}, {-.5, -9, -2.875});
  }
};

}  // namespace clues::validate::tests
