#include "fuzz/generators/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace clues::fuzz {

using scene::Point;

Random random_of(std::uint64_t seed, std::uint64_t index, std::uint64_t salt) {
  return Random(Random(Random(seed ^ (salt << 32)).next() ^ index).next());
}

double off(Random& random, double x, int dial) {
  const bool up = random.one_in(2);
  if (dial == 0 || random.one_in(2)) return x;
  if (dial == 1) return std::nextafter(x, up ? HUGE_VAL : -HUGE_VAL);
  return x + std::ldexp(up ? 1 : -1, -40 + 6 * (dial - 2));
}

GeneratedScene base_scene(Random& random) {
  while (true) {
    GeneratedScene scene = generate(any(all_kinds, random), random.next(), 0);
    if (scene.mesh.triangles.size() <= 30) return scene;
  }
}

void add(scene::TriangleMesh& mesh, const Point& a, const Point& b, const Point& c) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {a, b, c});
  mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_quad(scene::TriangleMesh& mesh, const Point& a, const Point& b, const Point& c, const Point& d) {
  add(mesh, a, b, c);
  add(mesh, a, c, d);
}

void add_receiver(scene::TriangleMesh& mesh, double x) {
  add_quad(mesh, {x, -2, -2}, {x, -2, 10}, {x, 10, 10}, {x, 10, -2});
}

std::vector<Point> box_of(const Point& lo, const Point& hi) {
  std::vector<Point> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]});
  return corners;
}

scene::TriangleMesh closed_box(const Point& lo, const Point& hi) {
  scene::TriangleMesh mesh;
  mesh.points = box_of(lo, hi);
  for (const auto& [a, b, c, d] : box_sides) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

std::vector<Point> distinct_corners(const Point& lo, const Point& hi) {
  auto corners = box_of(lo, hi);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::array<std::size_t, 3> shuffled_axes(Random& random) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  for (std::size_t i = 2; i > 0; --i)
    std::swap(axes[i], axes[static_cast<std::size_t>(random.between(0, static_cast<int>(i)))]);
  return axes;
}

bool is_closed(const scene::TriangleMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, times] : edges) {
    const auto back = edges.find({edge[1], edge[0]});
    if (times != 1 || back == edges.end()) return false;
  }
  return true;
}

}  // namespace clues::fuzz
