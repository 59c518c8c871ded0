#include "fuzz/generators/cell_shapes.h"

#include <algorithm>

#include "fuzz/generators/parts.h"

namespace clues::fuzz {
namespace {

using scene::Point;

Point plus(const Point& p, const Point& d, double by = 1) {
  return {p[0] + by * d[0], p[1] + by * d[1], p[2] + by * d[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Point& d) { return d[0] == 0 && d[1] == 0 && d[2] == 0; }

Point small_direction(Random& random) {
  Point d{};
  while (is_zero(d)) {
    for (double& x : d) x = random.between(-1, 1);
  }
  return d;
}

using Flat = std::vector<std::array<int, 2>>;

// Convex polygons with small corners, counter-clockwise.
const std::vector<Flat> small_polygons{{{0, 0}, {2, 0}, {0, 2}},         {{0, 0}, {2, 0}, {1, 2}},
                                       {{0, 0}, {3, 1}, {1, 2}},         {{0, 0}, {2, 0}, {2, 2}, {0, 2}},
                                       {{0, 0}, {2, 0}, {2, 1}, {0, 2}}, {{1, 0}, {2, 1}, {1, 2}, {0, 1}},
                                       {{0, 0}, {2, 0}, {3, 1}, {1, 2}}};
const std::vector<Flat> large_polygons{{{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}},
                                       {{1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 1}},
                                       {{1, 0}, {2, 0}, {3, 1}, {2, 2}, {1, 2}, {0, 1}},
                                       {{0, 0}, {1, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}}};

CellShape polygon(const Flat& flat, const Point& origin, const Point& u, const Point& w) {
  CellShape shape;
  shape.dimension = 2;
  std::vector<std::size_t> face;
  for (const auto& [x, y] : flat) {
    face.push_back(shape.vertices.size());
    shape.vertices.push_back(plus(plus(origin, u, x), w, y));
  }
  for (std::size_t i = 0; i < face.size(); ++i) shape.edges.push_back({i, (i + 1) % face.size()});
  shape.faces.push_back(face);
  return shape;
}

CellShape prism(CellShape base, const Point& along) {
  const std::size_t n = base.vertices.size();
  base.dimension = 3;
  std::vector<std::size_t> top;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    top.push_back(n + i);
    base.vertices.push_back(plus(base.vertices[i], along));
    base.edges.push_back({i, n + i});
    base.edges.push_back({n + i, n + j});
    base.faces.push_back({i, j, n + j, n + i});
  }
  base.faces.push_back(top);
  return base;
}

CellShape pyramid(CellShape base, const Point& apex) {
  const std::size_t n = base.vertices.size();
  base.dimension = 3;
  base.vertices.push_back(apex);
  for (std::size_t i = 0; i < n; ++i) {
    base.edges.push_back({i, n});
    base.faces.push_back({i, (i + 1) % n, n});
  }
  return base;
}

}  // namespace

CellShape cell_shape(int kind, Random& random) {
  Point origin;
  for (double& x : origin) x = random.between(-1, 1);
  if (kind == 0) return {0, {origin}, {}, {}};
  const auto first = static_cast<std::size_t>(random.between(0, 2));
  Point axis[3] = {};  // the axes, beginning with any
  for (std::size_t i = 0; i < 3; ++i) axis[i][(first + i) % 3] = 1;
  if (kind <= 2) {
    const double length = random.between(1, 4);
    const Point d = kind == 1 ? axis[0] : plus(small_direction(random), axis[0], 2);
    return {1, {origin, plus(origin, d, kind == 1 ? length : 1)}, {{0, 1}}, {}};
  }
  if (kind == 3 || kind == 6) {
    Flat flat{{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    flat[1][0] = flat[2][0] = random.between(1, 3);
    flat[2][1] = flat[3][1] = random.between(1, 3);
    CellShape shape = polygon(flat, origin, axis[0], axis[1]);
    return kind == 3 ? shape : prism(std::move(shape), plus({}, axis[2], random.between(1, 3)));
  }
  Point u{}, w{};
  while (is_zero(cross(u, w))) {
    u = small_direction(random);
    w = small_direction(random);
  }
  const bool few = kind == 4 || (kind == 7 && !random.one_in(4));
  const CellShape base = polygon(any(few ? small_polygons : large_polygons, random), origin, u, w);
  if (kind <= 5) return base;
  Point along{};
  const Point normal = cross(u, w);
  while (along[0] * normal[0] + along[1] * normal[1] + along[2] * normal[2] == 0) along = small_direction(random);
  if (random.one_in(2)) return prism(base, plus({}, along, random.between(1, 2)));
  const double height = random.between(1, 3);
  return pyramid(base, plus(any(base.vertices, random), along, height));
}

}  // namespace clues::fuzz
