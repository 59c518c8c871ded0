#include "fuzz/generators/built_scenes.h"

#include <algorithm>
#include <cmath>

#include "fuzz/generators/city.h"
#include "fuzz/generators/grid_mesh.h"
#include "fuzz/generators/parts.h"

namespace clues::fuzz {
namespace {

using scene::Point;

// The convex hull of integer points no four of which lie in a plane; false where some do. O(n^4), for a dozen points.
bool add_hull(GridMesh& mesh, const std::vector<GridPoint>& points) {
  std::vector<std::array<GridPoint, 3>> facets;
  for (const auto& a : points) {
    for (const auto& b : points) {
      for (const auto& c : points) {
        if (!(a < b && a < c) || b == c) continue;
        bool outside = false;
        for (const auto& d : points) {
          if (d == a || d == b || d == c) continue;
          const auto v = volume(a, b, c, d);
          if (v == 0) return false;
          outside = outside || v > 0;
        }
        if (!outside) facets.push_back({a, b, c});
      }
    }
  }
  for (const auto& [a, b, c] : facets) mesh.triangle(a, b, c);
  return true;
}

// `dial` + 4 points each.
void add_polytope(GridMesh& mesh, Random& random, const GridPoint& lo, int dial) {
  std::vector<GridPoint> points;
  do {
    points.clear();
    while (static_cast<int>(points.size()) < 4 + dial) {
      const GridPoint p{lo[0] + random.between(0, 44), lo[1] + random.between(0, 44), lo[2] + random.between(0, 44)};
      if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
    }
  } while (!add_hull(mesh, points));
}

GeneratedScene polytopes(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 20);
  GridMesh mesh(16);
  const int n = random.between(1, 2);
  for (int i = 0; i < n; ++i)
    add_polytope(mesh, random, {48 * i, random.between(0, 32), random.between(0, 32)}, dial_of(index));
  GeneratedScene scene;
  scene.mesh = std::move(mesh).take();
  scene.solid = random.one_in(2);
  if (!scene.solid) add_receiver(scene.mesh, 7);
  const double y = random.between(-32, 48) / 16.0, z = random.between(-32, 48) / 16.0;
  scene.cell = box_of({-2, y, z}, {-0.5, y + random.between(1, 32) / 16.0, z + random.between(1, 32) / 16.0});
  return scene;
}

GeneratedScene solids(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 21);
  while (true) {
    const Kind kind = random.one_in(3) ? Kind::tetrahedra : Kind::nonconvex_solids;
    GeneratedScene scene = generate(kind, random.next(), 0);
    scene.solid = true;
    // A cell that touches a solid may lie in part inside it: dial 0 keeps them.
    if (is_closed(scene.mesh) && scene.mesh.triangles.size() <= 32) return scene;
  }
}

// The part of a plane x = const between y0, z0 and y1, z1, but for an opening a..b, c..d.
void add_wall_with_opening(GridMesh& mesh, int x, int y0, int z0, int y1, int z1, int a, int b, int c, int d) {
  const auto part = [&](int u0, int w0, int u1, int w1) {
    if (u0 < u1 && w0 < w1) mesh.quad({x, u0, w0}, {x, u0, w1}, {x, u1, w1}, {x, u1, w0});
  };
  part(y0, z0, a, z1);
  part(b, z0, y1, z1);
  part(a, z0, b, c);
  part(a, d, b, z1);
}

// Rooms one behind the other: openings as high as a person or as narrow as a slit, stairs and a box behind them. All on a grid of quarters.
GeneratedScene interiors(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 22);
  GridMesh mesh(4);
  const int dial = dial_of(index), width = 16, height = 12;
  const int walls = 1 + dial % 2;
  for (int i = 0; i < walls; ++i) {
    const int x = 4 + 8 * i, a = random.between(2, 12), b = a + (dial >= 6 ? 1 : random.between(1, 14 - a));
    const bool door = random.one_in(2);
    const int c = door ? 0 : random.between(2, 6), d = random.between(c + 1, 11);
    add_wall_with_opening(mesh, x, 0, 0, width, height, a, b, c, d);
  }
  const int back = 4 + 8 * walls;
  mesh.quad({back, 0, 0}, {back, 0, height}, {back, width, height}, {back, width, 0});
  if ((dial & 2) != 0) mesh.quad({-4, 0, 0}, {back, 0, 0}, {back, width, 0}, {-4, width, 0});  // floor
  if ((dial & 4) != 0) {                                                                       // stairs
    const int from = random.between(1, 10), to = from + random.between(2, 5);
    for (int i = 0; i < 3; ++i) {
      const int x = back - 7 + 2 * i;
      mesh.quad({x, from, i}, {x, from, i + 1}, {x, to, i + 1}, {x, to, i});
      mesh.quad({x, from, i + 1}, {x + 2, from, i + 1}, {x + 2, to, i + 1}, {x, to, i + 1});
    }
  } else if (random.one_in(2)) {
    const int y = random.between(1, 12), h = random.between(1, 6);
    mesh.box({back - 4, y, 0}, {back - 2, y + 2, h});
  }
  GeneratedScene scene;
  scene.mesh = std::move(mesh).take();
  const double y = random.between(0, 12) / 4.0, z = random.between(0, 8) / 4.0;
  scene.cell = box_of({-0.75, y, z},
                      {random.one_in(3) ? 1 : 0.25, y + random.between(1, 4) / 4.0, z + random.between(1, 4) / 4.0});
  return scene;
}

GeneratedScene city_blocks(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 23);
  const std::uint64_t city = random.next();
  const auto triangles = static_cast<std::uint32_t>(26 + 6 * dial_of(index));
  GeneratedScene scene;
  scene.mesh = make_city(triangles, city);
  scene.cell = street_cell(triangles, city);
  return scene;
}

// Blades and spikes in a few rows, the thinner the higher the dial: 1/2 to 2^-29 wide.
GeneratedScene forests(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 24);
  GeneratedScene scene;
  const double width = std::ldexp(1, -1 - 4 * dial_of(index));
  for (int n = random.between(6, 14); n > 0; --n) {
    const double x = 1 + random.between(0, 3) / 2.0, y = random.between(0, 128) / 16.0,
                 z = random.between(-8, 48) / 16.0;
    const double lean = random.one_in(2) ? 0 : random.between(-16, 16) / 16.0, top = z + random.between(16, 80) / 16.0;
    add(scene.mesh, {x, y, z}, {x, y + width, z}, {x + lean, y + width * random.between(0, 4) / 4, top});
  }
  add_receiver(scene.mesh, 4);
  const double size = random.between(1, 24) / 16.0;
  scene.cell = box_of({-2, 4 - size, 3 - size}, {-1, 4 + size, 3 + size});
  return scene;
}

// A fan around a centre; neighbours meet, overlap or gape as the dial says, and something small is behind it.
GeneratedScene umbrellas(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 25);
  GeneratedScene scene;
  const int dial = dial_of(index), n = random.between(3, 7);
  const double bow = random.between(-8, 8) / 8.0;
  std::vector<Point> rim;
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * 3.14159265358979 * i / n, r = random.between(40, 64) / 16.0;
    rim.push_back(
        {2 + bow, 4 + std::round(16 * r * std::cos(turn)) / 16, 4 + std::round(16 * r * std::sin(turn)) / 16});
  }
  const auto shifted = [&](Point p) {
    for (double& x : p) x = off(random, x, dial);
    return p;
  };
  const Point top{2, 4 + random.between(-8, 8) / 16.0, 4 + random.between(-8, 8) / 16.0};
  for (std::size_t i = 0; i < rim.size(); ++i)
    add(scene.mesh, shifted(top), shifted(rim[i]), shifted(rim[(i + 1) % rim.size()]));
  const double y = random.between(40, 80) / 16.0, z = random.between(40, 80) / 16.0,
               x = 3 + random.between(2, 16) / 16.0;
  add(scene.mesh, {x, y, z}, {x, y + 0.5, z}, {x, y, z + 0.5});
  add_receiver(scene.mesh, 5);
  const double size = random.between(1, 16) / 16.0;
  scene.cell = box_of({-2, 4 - size, 4 - size}, {0, 4 + size, 4 + size});
  return scene;
}

// Edges parallel to edges and face diagonals of the cell, triangles in the planes of its faces; with the dial they are off by so much.
GeneratedScene parallel_edges(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 26);
  GeneratedScene scene;
  const int dial = dial_of(index);
  const auto sixteenths = [&](int lo, int hi) { return random.between(lo, hi) / 16.0; };
  const Point lo{-2, sixteenths(16, 64), sixteenths(16, 64)},
      hi{-1, lo[1] + sixteenths(4, 40), lo[2] + sixteenths(4, 40)};
  scene.cell = box_of(lo, hi);
  for (int n = random.between(4, 12); n > 0; --n) {
    Point a{sixteenths(0, 48), sixteenths(0, 112), sixteenths(0, 112)};
    for (std::size_t i = 1; i < 3; ++i) {
      if (random.one_in(3)) a[i] = random.one_in(2) ? lo[i] : hi[i];
    }
    const Point &s = any(scene.cell, random), &t = any(scene.cell, random);
    const double length = random.between(1, 8) / 2.0;
    Point b = a, c = a;
    for (std::size_t i = 0; i < 3; ++i) b[i] += length * (t[i] - s[i]);
    const auto up = static_cast<std::size_t>(random.between(0, 2));
    c[up] += sixteenths(4, 40);
    c[(up + 1) % 3] += random.one_in(2) ? 0 : sixteenths(-24, 24);
    for (Point* p : {&b, &c}) {
      for (double& x : *p) x = off(random, x, dial);
    }
    // Not without area, and in front of the cell.
    if (b == a || std::min(b[0], c[0]) < 0) continue;
    const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, w{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double area =
        std::abs(u[1] * w[2] - u[2] * w[1]) + std::abs(u[2] * w[0] - u[0] * w[2]) + std::abs(u[0] * w[1] - u[1] * w[0]);
    if (area > 0.125) add(scene.mesh, a, b, c);
  }
  add_receiver(scene.mesh, 8);
  return scene;
}

}  // namespace

const std::vector<DegenerateGenerator>& built_generators() {
  static const std::vector<DegenerateGenerator> all{
      {"polytopes", "convex polytopes of 4 to 11 corners (dial), half of them in solid mode", polytopes},
      {"solids", "closed solids with notches and reflex edges, in solid mode", solids},
      {"interiors", "rooms with doors, windows, stairs; the dial adds rooms, floor, stairs, and narrows openings",
       interiors},
      {"city_blocks", "a street with buildings of 26 to 68 triangles (dial)", city_blocks},
      {"forests", "thin blockers in rows, 1/2 to 2^-29 wide (dial)", forests},
      {"umbrellas", "a fan that is closed (dial 0), or gapes and overlaps by an ulp (1) or 2^-40 to 2^-10", umbrellas},
      {"parallel_edges",
       "edges parallel to the cell's, in the planes of its faces; off by nothing, an ulp, 2^-40 to 2^-10 (dial)",
       parallel_edges}};
  return all;
}

}  // namespace clues::fuzz
