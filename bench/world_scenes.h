// Scenes unlike our own city, for bench/world.cpp: families in which coordinates are long, contact is everywhere, openings are thin, or nothing
// hides anything; and cells beside the walls of meshes from elsewhere. All are pure functions of size and seed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/generators/parts.h"
#include "fuzz/generators/random.h"
#include "scene/mesh/mesh.h"

namespace clues::bench {

struct WorldScene {
  std::string name;
  scene::TriangleMesh mesh;
  std::vector<std::vector<scene::Point>> cells;
};

inline double uniform(fuzz::Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random.next() >> 11) * 0x1p-53);
}

class SceneMaker {
 public:
  explicit SceneMaker(std::string name) { scene_.name = std::move(name); }

  std::uint32_t point(const scene::Point& p) {
    scene_.mesh.points.push_back(p);
    return static_cast<std::uint32_t>(scene_.mesh.points.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene_.mesh.face_of.push_back(static_cast<std::uint32_t>(scene_.mesh.triangles.size()));
    scene_.mesh.triangles.push_back({a, b, c});
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  // Corners in the order of fuzz::box_of.
  void closed_box(const std::vector<scene::Point>& corners) {
    std::array<std::uint32_t, 8> p{};
    for (std::size_t i = 0; i < 8; ++i) p[i] = point(corners[i]);
    for (const auto& [a, b, c, d] : fuzz::box_sides) quad(p[a], p[b], p[c], p[d]);
  }
  void ground(double half) {
    quad(point({-half, -half, 0}), point({half, -half, 0}), point({half, half, 0}), point({-half, half, 0}));
  }
  void cell(const scene::Point& low, const scene::Point& high) { scene_.cells.push_back(fuzz::box_of(low, high)); }
  WorldScene take() { return std::move(scene_); }

 private:
  WorldScene scene_;
};

// Boxes turned at random about z, some of them through each other, on a ground: coordinates of 53 bits, and quads whose halves
// are coplanar but for an ulp.
inline WorldScene turned_boxes(std::uint32_t boxes, std::uint64_t seed) {
  SceneMaker make("turned boxes");
  fuzz::Random random(seed);
  const double half = 3 * std::sqrt(static_cast<double>(boxes));
  make.ground(half + 10);
  for (std::uint32_t i = 0; i < boxes; ++i) {
    const double x = uniform(random, -half, half), y = uniform(random, -half, half);
    const double w = uniform(random, 0.5, 2.5), d = uniform(random, 0.5, 2.5), h = uniform(random, 1, 9);
    const double angle = uniform(random, 0, 1.5), c = std::cos(angle), s = std::sin(angle);
    if (std::hypot(x, y) < 5) continue;
    std::vector<scene::Point> corners = fuzz::box_of({-w, -d, 0}, {w, d, h});
    for (scene::Point& p : corners) p = {x + c * p[0] - s * p[1], y + s * p[0] + c * p[1], p[2]};
    make.closed_box(corners);
  }
  make.cell({-0.7, -0.6, 1.1}, {0.9, 0.8, 1.9});
  return make.take();
}

// Equal boxes on a grid, and a cell aligned with them: wedges graze faces by the hundred.
inline WorldScene axis_grid(std::uint32_t side, std::uint64_t seed) {
  SceneMaker make("axis grid");
  fuzz::Random random(seed);
  const auto n = static_cast<int>(side);
  make.ground(4.0 * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = 4 * (i - n / 2) + 1, y = 4 * (j - n / 2) + 1;
      const double h = 2 + static_cast<double>(random.next() % 4);
      if (i == n / 2 && j == n / 2) continue;
      make.closed_box(fuzz::box_of({x, y, 0}, {x + 2, y + 2, h}));
    }
  }
  make.cell({1, 1, 1}, {3, 3, 2});
  return make.take();
}

// A wall of hexagonal openings before boxes.
inline WorldScene honeycomb(std::uint32_t openings, std::uint64_t seed) {
  SceneMaker make("honeycomb");
  fuzz::Random random(seed);
  const auto n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(openings))));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i + (j % 2 == 0 ? 0 : 0.5), z = 0.875 * j;
      std::array<std::uint32_t, 6> in{}, out{};
      for (std::size_t k = 0; k < 6; ++k) {
        const double a = (static_cast<double>(k) + 0.5) * 1.0471975511965976, r = 0.5773502691896258;
        out[k] = make.point({x + r * std::cos(a), 0, z + r * std::sin(a)});
        in[k] = make.point({x + 0.7 * r * std::cos(a), 0, z + 0.7 * r * std::sin(a)});
      }
      for (std::size_t k = 0; k < 6; ++k) make.quad(out[k], out[(k + 1) % 6], in[(k + 1) % 6], in[k]);
    }
  }
  for (std::uint32_t i = 0; i < openings; ++i) {
    const double x = uniform(random, 0, n), y = uniform(random, 2, 8), z = uniform(random, 0, 0.875 * n), r = 0.2;
    make.closed_box(fuzz::box_of({x, y, z}, {x + r, y + r, z + r}));
  }
  make.cell({0.4 * n, -3, 0.4 * n}, {0.4 * n + 0.5, -2.5, 0.4 * n + 0.5});
  return make.take();
}

// Two rows of slats before boxes.
inline WorldScene blinds(std::uint32_t slats, std::uint64_t seed) {
  SceneMaker make("blinds");
  fuzz::Random random(seed);
  for (int row = 0; row < 2; ++row) {
    for (std::uint32_t i = 0; i < slats; ++i) {
      const double z = i * 0.5 + 0.1 * row, y = 2.0 * row, tilt = 0.2 + 0.1 * row;
      make.quad(make.point({-10, y, z}), make.point({10, y, z}), make.point({10, y + tilt, z + 0.3}),
                make.point({-10, y + tilt, z + 0.3}));
    }
  }
  for (std::uint32_t i = 0; i < slats; ++i) {
    const double x = uniform(random, -9, 9), y = uniform(random, 4, 9), z = uniform(random, 0, 0.5 * slats), r = 0.5;
    make.closed_box(fuzz::box_of({x, y, z}, {x + r, y + r, z + r}));
  }
  make.cell({-0.5, -3, 0.2 * slats}, {0.5, -2.5, 0.2 * slats + 0.5});
  return make.take();
}

// A strip of rough ground, as a grid of ramps.
inline WorldScene terrain(std::uint32_t quads_across, std::uint64_t seed) {
  SceneMaker make("terrain");
  fuzz::Random random(seed);
  const std::uint32_t across = quads_across, along = 4 * quads_across;
  std::vector<std::uint32_t> at;
  for (std::uint32_t j = 0; j <= along; ++j) {
    for (std::uint32_t i = 0; i <= across; ++i)
      at.push_back(make.point({static_cast<double>(i), static_cast<double>(j),
                               uniform(random, 0, 1) + 2 * std::sin(0.7 * i) * std::cos(0.4 * j)}));
  }
  for (std::uint32_t j = 0; j < along; ++j) {
    for (std::uint32_t i = 0; i < across; ++i) {
      const std::uint32_t p = j * (across + 1) + i;
      make.quad(at[p], at[p + 1], at[p + across + 2], at[p + across + 1]);
    }
  }
  make.cell({0.4 * across, -2, 2.5}, {0.4 * across + 1, -1, 3.5});
  return make.take();
}

// Loose triangles: nothing hides much.
inline WorldScene loose_triangles(std::uint32_t count, std::uint64_t seed) {
  SceneMaker make("loose triangles");
  fuzz::Random random(seed);
  const double half = std::cbrt(static_cast<double>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const scene::Point c{uniform(random, -half, half), uniform(random, -half, half), uniform(random, 2, 2 + 2 * half)};
    std::array<std::uint32_t, 3> p{};
    for (std::uint32_t& k : p) {
      scene::Point q = c;
      for (double& x : q) x += uniform(random, -0.7, 0.7);
      k = make.point(q);
    }
    make.triangle(p[0], p[1], p[2]);
  }
  make.cell({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  return make.take();
}

// Boxes beside the middles of large triangles, on either side, at most `count`: where somebody stands who looks at a wall. Their side is 1/48
// of the mesh's middle extent (about 32 units in a level of the Quake 3 family), their coordinates are multiples of 1/16 of a side.
inline std::vector<std::vector<scene::Point>> cells_beside_walls(const scene::TriangleMesh& mesh, std::size_t count,
                                                                 std::uint64_t seed) {
  scene::Point low = mesh.points.at(0), high = low;
  for (const scene::Point& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  std::array<double, 3> extent{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::sort(extent.begin(), extent.end());
  const double side = std::exp2(std::round(std::log2(extent[1] / 48)));
  fuzz::Random random(seed);
  std::vector<std::vector<scene::Point>> cells;
  for (int tries = 0; cells.size() < count && tries < 100000; ++tries) {
    const scene::Triangle& t = mesh.triangles[random.next() % mesh.triangles.size()];
    const scene::Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    scene::Point n{}, u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
    }
    for (std::size_t k = 0; k < 3; ++k) n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    const double length = std::hypot(n[0], n[1], n[2]), way = random.next() % 2 == 0 ? 0.75 : -0.75;
    if (length < 4 * side * side && tries < 50000) continue;
    if (length == 0) continue;
    scene::Point from{}, to{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = (a[k] + b[k] + c[k]) / 3 + way * side * n[k] / length;
      from[k] = std::round(16 * x / side) * side / 16 - side / 2;
      to[k] = from[k] + side;
    }
    cells.push_back(fuzz::box_of(from, to));
  }
  return cells;
}

}  // namespace clues::bench
