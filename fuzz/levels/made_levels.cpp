#include "fuzz/levels/made_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fuzz/generators/city.h"
#include "fuzz/generators/grid_mesh.h"
#include "fuzz/generators/parts.h"
#include "scene/mesh/bounds.h"

namespace clues::fuzz {
namespace {

using scene::Bounds;
using scene::FlaggedMesh;
using scene::Point;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross_of(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::array<Point, 3> corners_of(const scene::TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

// Whether an axis parts the triangle from the box, rounded: it only chooses cells.
bool overlap(const std::array<Point, 3>& t, const Bounds& box) {
  if (!scene::touch(scene::bounds_of(t), box)) return false;
  Point center, half;
  for (std::size_t i = 0; i < 3; ++i) {
    center[i] = (box.low[i] + box.high[i]) / 2;
    half[i] = (box.high[i] - box.low[i]) / 2;
  }
  const std::array<Point, 3> v{minus(t[0], center), minus(t[1], center), minus(t[2], center)};
  const std::array<Point, 3> edges{minus(v[1], v[0]), minus(v[2], v[1]), minus(v[0], v[2])};
  const auto parts = [&](const Point& axis) {
    const double r = half[0] * std::abs(axis[0]) + half[1] * std::abs(axis[1]) + half[2] * std::abs(axis[2]);
    const auto [low, high] = std::minmax({dot(v[0], axis), dot(v[1], axis), dot(v[2], axis)});
    return low > r || high < -r;
  };
  if (parts(cross_of(edges[0], edges[1]))) return false;
  for (const Point& e : edges) {
    if (parts({0, -e[2], e[1]}) || parts({e[2], 0, -e[0]}) || parts({-e[1], e[0], 0})) return false;
  }
  return true;
}

bool is_free(const FlaggedMesh& scene, const Bounds& box) {
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (overlap(corners_of(scene.mesh, t), box)) return false;
  }
  return true;
}

// Corners with floats as coordinates, so that numbers stay short.
std::vector<Point> short_box(const Bounds& box) {
  Bounds b;
  const auto shortened = [](double x) {
    return std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max()) ? static_cast<float>(x) : x;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    b.low[i] = shortened(box.low[i]);
    b.high[i] = shortened(box.high[i]);
  }
  return scene::corners_of(b);
}

// Near something that counts, mostly before its front; it meets nothing if that can be had. One box of eight is taken as it comes, one of eight is flat.
std::vector<Point> box_near_something(const FlaggedMesh& scene, Random& random) {
  const auto all = scene::bounds_of(scene.mesh.points);
  const Point size = minus(all.high, all.low);
  const double diagonal = std::sqrt(dot(size, size));
  const bool as_it_comes = random.one_in(8), flat = random.one_in(8);
  Bounds box{all.low, all.high};
  if (!std::isfinite(diagonal)) return short_box(box);
  for (int tries = 0; tries < 24; ++tries) {
    const auto t = static_cast<std::size_t>(random.next() % scene.mesh.triangles.size());
    if (!scene.counting(static_cast<std::uint32_t>(t))) continue;
    const auto corners = corners_of(scene.mesh, t);
    const Point normal = cross_of(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0) || !std::isfinite(length)) continue;
    const double a = random.between(1, 16), b = random.between(1, 16), c = random.between(1, 16);
    double away = diagonal * std::ldexp(1, -random.between(4, 10)) / length;
    if (random.one_in(4)) away = -away;
    Point half, at;
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = (a * corners[0][i] + b * corners[1][i] + c * corners[2][i]) / (a + b + c) + away * normal[i];
      half[i] = flat && random.one_in(2) ? 0 : diagonal * std::ldexp(1, -random.between(5, 11));
    }
    for (int halved = 0; halved < 6; ++halved) {
      for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = at[i] - half[i];
        box.high[i] = at[i] + half[i];
        half[i] /= 2;
      }
      if (as_it_comes || is_free(scene, box)) return short_box(box);
    }
  }
  return short_box(box);
}

struct Flagger {
  FlaggedMesh& scene;
  void add(std::size_t triangles, bool blocks, bool counts) const {
    scene.blocks.resize(triangles, blocks ? 1 : 0);
    scene.counts.resize(triangles, counts ? 1 : 0);
  }
};

// A wall across axis 0 or 1, at `at`, from u0 to u1 along the other and from z0 to z1; with an opening a..b, c..d.
void add_level_wall(GridMesh& mesh, int axis, int at, std::array<int, 4> wall, std::array<int, 4> opening) {
  const auto part = [&](int u0, int w0, int u1, int w1) {
    if (u0 >= u1 || w0 >= w1) return;
    if (axis == 0) {
      mesh.quad({at, u0, w0}, {at, u0, w1}, {at, u1, w1}, {at, u1, w0});
    } else {
      mesh.quad({u0, at, w0}, {u0, at, w1}, {u1, at, w1}, {u1, at, w0});
    }
  };
  const auto [u0, z0, u1, z1] = wall;
  const auto [a, c, b, d] = opening;
  part(u0, z0, a, z1);
  part(b, z0, u1, z1);
  part(a, z0, b, c);
  part(a, d, b, z1);
}

void shift_points(FlaggedMesh& scene, Random& random, int dial) {
  for (Point& p : scene.mesh.points) {
    for (double& x : p) x = off(random, x, dial);
  }
}

}  // namespace

SceneInALevel rooms_of_a_level(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 41);
  constexpr int room = 64, height = 48;  // in sixteenths
  const int nx = random.between(3, 9), ny = random.between(3, 9), storeys = random.between(1, 2);
  SceneInALevel out;
  GridMesh mesh(16);
  const Flagger flags{out.scene};
  const auto add_side = [&](int axis, int i, int j, int z, bool outside) {
    const int at = room * (axis == 0 ? i : j), u = room * (axis == 0 ? j : i);
    const std::array<int, 4> wall{u, z, u + room, z + height};
    if (outside || random.one_in(4)) {
      add_level_wall(mesh, axis, at, wall, {u, z, u, z});
      return flags.add(mesh.size(), true, true);
    }
    if (random.one_in(8)) return;  // one room of two
    const bool door = random.one_in(2);
    const int a = u + random.between(1, 40), b = a + random.between(1, 20);
    const int c = z + (door ? 0 : random.between(8, 24)), d = c + random.between(2, 20);
    add_level_wall(mesh, axis, at, wall, {a, c, b, d});
    flags.add(mesh.size(), true, true);
    if (door || random.one_in(3)) return;
    add_level_wall(mesh, axis, at, {a, c, b, d}, {a, c, a, c});  // a pane
    flags.add(mesh.size(), false, true);
  };
  for (int s = 0; s < storeys; ++s) {
    const int z = s * height;
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        if (j < ny) add_side(0, i, j, z, i == 0 || i == nx);
        if (i < nx) add_side(1, i, j, z, j == 0 || j == ny);
        if (i == nx || j == ny) continue;
        const int x = i * room, y = j * room;
        if (s == 0 || !random.one_in(6))
          mesh.quad({x, y, z}, {x + room, y, z}, {x + room, y + room, z}, {x, y + room, z});
        if (s + 1 == storeys)
          mesh.quad({x, y, z + height}, {x, y + room, z + height}, {x + room, y + room, z + height},
                    {x + room, y, z + height});
        flags.add(mesh.size(), true, true);
        for (int n = random.between(0, 2); n > 0; --n) {
          const int px = x + random.between(4, 48), py = y + random.between(4, 48), w = random.between(4, 12);
          const int top = random.one_in(2) ? height : random.between(6, 30);
          mesh.box({px, py, z}, {px + w, py + w, z + top});
          flags.add(mesh.size(), true, true);
          if (!random.one_in(2)) continue;
          mesh.box({px + 1, py + 1, z + 1}, {px + w - 1, py + w - 1, z + top - 1});  // the hull of its brush
          flags.add(mesh.size(), true, false);
        }
        if (random.one_in(3)) {  // as of a curve: it counts, and nothing is known to stop at it
          const int px = x + random.between(4, 50), py = y + random.between(4, 50);
          mesh.triangle({px, py, z + 4}, {px + 9, py + 3, z + 5}, {px + 2, py + 8, z + 30});
          flags.add(mesh.size(), false, true);
        }
      }
    }
  }
  out.scene.mesh = std::move(mesh).take();
  shift_points(out.scene, random, dial_of(index));
  out.cell = box_near_something(out.scene, random);
  return out;
}

SceneInALevel streets_of_a_level(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 42);
  SceneInALevel out;
  out.scene.mesh = make_city(static_cast<std::uint32_t>(random.between(400, 4000)), random.next());
  if (!random.one_in(4)) {
    const Flagger flags{out.scene};
    for (std::size_t t = 0; t < out.scene.mesh.triangles.size(); ++t) {
      const int kind = random.between(0, 15);
      flags.add(t + 1, kind > 1, kind != 2);
    }
  }
  shift_points(out.scene, random, dial_of(index));
  out.cell = box_near_something(out.scene, random);
  return out;
}

SceneInALevel box_in_a_level(const std::vector<GivenLevel>& levels, std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 43);
  SceneInALevel out;
  out.scene = any(levels, random).scene;
  out.cell = box_near_something(out.scene, random);
  return out;
}

SceneInALevel leaf_of_a_level(const std::vector<GivenLevel>& levels, std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 44);
  while (true) {
    const GivenLevel& level = any(levels, random);
    if (!level.cells.empty()) return {level.scene, any(level.cells, random)};
  }
}

}  // namespace clues::fuzz
