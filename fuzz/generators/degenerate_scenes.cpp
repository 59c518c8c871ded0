#include "fuzz/generators/degenerate_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fastpath/predicates/estimated_vectors.h"
#include "fuzz/generators/grid_mesh.h"
#include "fuzz/generators/parts.h"
#include "fuzz/generators/touching_scenes.h"

namespace clues::fuzz {
namespace {

using scene::Point;

GeneratedScene slivers(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 1);
  GeneratedScene scene = base_scene(random);
  for (int n = random.between(2, 6); n > 0; --n) {
    const Point a = any(scene.mesh.points, random), b = any(scene.mesh.points, random);
    Point c;
    for (std::size_t i = 0; i < 3; ++i)
      c[i] = off(random, a[i] / 2 + b[i] / 2, dial_of(index));  // now and then without area
    add(scene.mesh, a, b, c);
  }
  return scene;
}

GeneratedScene duplicates(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 2);
  GeneratedScene scene = base_scene(random);
  for (int n = 1 + dial_of(index); n > 0; --n) {
    scene::Triangle t =
        scene.mesh
            .triangles[static_cast<std::size_t>(random.between(0, static_cast<int>(scene.mesh.triangles.size()) - 1))];
    if (random.one_in(2)) std::swap(t[0], t[1]);
    scene.mesh.triangles.push_back(t);
    scene.mesh.face_of.push_back(static_cast<std::uint32_t>(scene.mesh.face_of.size()));
  }
  return scene;
}

GeneratedScene ulp_perturbed(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 3);
  GeneratedScene scene = base_scene(random);
  for (int n = 1 + dial_of(index); n > 0; --n) {
    double& x =
        any(random.one_in(4) ? scene.cell : scene.mesh.points, random)[static_cast<std::size_t>(random.between(0, 2))];
    x = std::nextafter(x, random.one_in(2) ? 1e300 : -1e300);
  }
  return scene;
}

GeneratedScene scaled_and_moved(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 4);
  GeneratedScene scene = base_scene(random);
  const double factor = std::ldexp(1, random.between(-10, 10) * (1 + dial_of(index)));
  Point offset;  // in units of the scene; far away coordinates lose their last bits, and the scene is what is left
  for (double& x : offset) x = random.one_in(2) ? 0 : std::ldexp(random.between(-9, 9), random.between(0, 44));
  for (auto* points : {&scene.mesh.points, &scene.cell}) {
    for (Point& p : *points) {
      for (std::size_t i = 0; i < 3; ++i) p[i] = (p[i] + offset[i]) * factor;
    }
  }
  return scene;
}

GeneratedScene cyclic_overlap(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 5);
  GeneratedScene scene;
  const int n = 3 + dial_of(index) % 6;
  // Corners of a polygon around (4, 4), in sixteenths; bar i reaches from corner i, in front, past corner i + 1, behind.
  std::vector<std::array<double, 2>> corners;
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * 3.14159265358979 * i / n;
    corners.push_back({4 + std::round(48 * std::cos(turn)) / 16, 4 + std::round(48 * std::sin(turn)) / 16});
  }
  const double width = random.between(2, 14) / 16.0, reach = random.between(1, 4) / 4.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double dy = b[0] - a[0], dz = b[1] - a[1];
    const Point from{2, a[0] - reach * dy, a[1] - reach * dz}, to{3, b[0] + reach * dy, b[1] + reach * dz};
    // Across the bar, towards the middle.
    const double my = (4 - (a[0] + b[0]) / 2) * width, mz = (4 - (a[1] + b[1]) / 2) * width;
    add_quad(scene.mesh, from, {from[0], from[1] + my, from[2] + mz}, {to[0], to[1] + my, to[2] + mz}, to);
  }
  add_receiver(scene.mesh, 5);
  const double size = random.between(2, 24) / 16.0;
  scene.cell = box_of({-2, 4 - size, 4 - size}, {-1, 4 + size, 4 + size});
  return scene;
}

// Panels that tile a square as seen from the cell, each at its own depth, with borders that meet, overlap or gape by next to nothing.
GeneratedScene nearly_closed(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 6);
  GeneratedScene scene;
  const int dial = dial_of(index), columns = random.between(2, 3), rows = random.between(1, 3);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double x = random.one_in(2) ? 2 : off(random, 2 + random.between(0, 2) / 4.0, dial);
      const double y0 = off(random, 8.0 * i / columns, dial), y1 = off(random, 8.0 * (i + 1) / columns, dial);
      const double z0 = off(random, 8.0 * j / rows, dial), z1 = off(random, 8.0 * (j + 1) / rows, dial);
      add_quad(scene.mesh, {x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {x, y1, z0});
    }
  }
  add_quad(scene.mesh, {4, 2, 2}, {4, 2, 6}, {4, 6, 6}, {4, 6, 2});
  const double size = random.one_in(3) ? 4 : random.between(1, 16) / 8.0;
  scene.cell = box_of({-2, 4 - size, 4 - size}, {random.one_in(4) ? 1.5 : 0.0, 4 + size, 4 + size});
  return scene;
}

GeneratedScene t_junctions(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 7);
  GeneratedScene scene;
  const int dial = dial_of(index);
  for (int column = 0; column < 3; ++column) {
    const int rows = random.between(1, 4);
    const double bend = random.between(-8, 8) / 16.0;  // columns fold along their common lines
    for (int row = 0; row < rows; ++row) {
      if (random.one_in(6)) continue;
      const double z0 = 8.0 * row / rows, z1 = 8.0 * (row + 1) / rows, y0 = 2.5 * column, y1 = 2.5 * (column + 1);
      const auto x = [&](double at) { return off(random, at, dial); };
      add_quad(scene.mesh, {x(2), y0, z0}, {x(2), y0, z1}, {x(column == 2 ? 2 + bend : 2), y1, z1},
               {x(column == 2 ? 2 + bend : 2), y1, z0});
    }
  }
  add_receiver(scene.mesh, 4);
  const double y = random.between(0, 64) / 16.0, z = random.between(0, 64) / 16.0;
  scene.cell = box_of({-2, y, z}, {-1, y + random.between(1, 48) / 16.0, z + random.between(1, 48) / 16.0});
  return scene;
}

// Axis-aligned rectangles in a few common planes, overlapping each other, and a cell with faces in the same planes.
GeneratedScene coplanar_walls(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 8);
  GeneratedScene scene;
  GridMesh mesh(1);
  for (int n = 2 + dial_of(index); n > 0; --n) {
    const auto axis = static_cast<std::size_t>(random.between(0, 2));
    GridPoint a;
    a[axis] = random.between(1, 3);
    const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
    a[u] = random.between(0, 4);
    a[w] = random.between(0, 4);
    GridPoint b = a, c = a, d = a;
    const int du = random.between(1, 3), dw = random.between(1, 3);
    b[u] += du;
    c[u] += du;
    c[w] += dw;
    d[w] += dw;
    if (random.one_in(2)) {
      mesh.quad(a, b, c, d);
    } else {
      mesh.quad(d, c, b, a);
    }
  }
  scene.mesh = std::move(mesh).take();
  const Point lo{static_cast<double>(random.between(-2, 0)), static_cast<double>(random.between(0, 3)),
                 static_cast<double>(random.between(0, 3))};
  scene.cell = box_of(lo, {lo[0] + 1, lo[1] + random.between(1, 2), lo[2] + random.between(1, 2)});
  return scene;
}

// A box with a mesh vertex on one of its faces, edges or corners; or around it.
GeneratedScene touching_cells(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 9);
  GeneratedScene scene = base_scene(random);
  const Point q = any(scene.mesh.points, random);
  const int shared = dial_of(index) % 4;  // coordinates in which q is on the border
  Point lo, hi;
  for (std::size_t i = 0; i < 3; ++i) {
    lo[i] = q[i] - random.between(1, 40) / 16.0;
    hi[i] = static_cast<int>(i) < shared ? q[i] : q[i] + random.between(1, 40) / 16.0;
  }
  scene.cell = box_of(lo, hi);
  return scene;
}

// Cells of dimension 0, 1 and 2.
GeneratedScene flat_cells(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 10);
  GeneratedScene scene = base_scene(random);
  while (scene.cell.size() > static_cast<std::size_t>(1 + index % 3)) {
    scene.cell.erase(scene.cell.begin() + random.between(0, static_cast<int>(scene.cell.size()) - 1));
  }
  return scene;
}

// Axis-aligned rectangles flush with the cell's sides and each other: gaps between them, steps and the cell itself are 1 to 2^-28 times as wide as
// the rest. A sight line to beside an edge then comes through the plane of its wedge far from the edge.
GeneratedScene thin_gaps(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 11);
  const double thin = std::ldexp(1.0, -4 * dial_of(index));
  const std::vector<double> places{-4, -thin, 0, thin, 4};
  const auto two = [&](bool may_be_one) {
    const int a = random.between(0, 3);
    const int b = may_be_one && random.one_in(10) ? a : random.between(a + 1, 4);
    return std::array<double, 2>{places[static_cast<std::size_t>(a)], places[static_cast<std::size_t>(b)]};
  };
  GeneratedScene scene;
  for (int n = random.between(2, 5); n > 0; --n) {
    const auto axis = static_cast<std::size_t>(random.between(0, 2));
    const std::size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
    Point a;
    a[axis] = any(places, random);
    const auto across = two(false), along = two(false);
    a[u] = across[0];
    a[w] = along[0];
    Point b = a, c = a, d = a;
    b[u] = c[u] = across[1];
    c[w] = d[w] = along[1];
    if (random.one_in(3)) {
      add(scene.mesh, a, b, c);
    } else {
      add_quad(scene.mesh, a, b, c, d);
    }
  }
  Point lo, hi;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto side = two(true);
    lo[i] = side[0];
    hi[i] = side[1];
  }
  scene.cell = box_of(lo, hi);
  return scene;
}

// Two plates on either side of a sight line, along a line across it that is as near to it as the window of an iris is wide.
void add_slit(GeneratedScene& scene, Random& random, const Point& on_line, const Point& along) {
  const auto in = [&](int low, int high) { return random.between(16 * low, 16 * high) / 16.0; };
  const auto to_grid = [](double x) { return std::nearbyint(64 * x) / 64; };
  const Point other{in(-4, 4), in(-4, 4), in(-4, 4) + 1.0 / 32};
  const auto across = [](const Point& a, const Point& b) {
    Point n = fastpath::cross_of(a, b);
    const double length = std::sqrt(fastpath::dot_of(n, n));
    for (double& x : n) x = length > 0 ? x / length : 0;
    return n;
  };
  const Point u = across(along, other), w = across(along, u);
  const auto at = [&](double by_u, double by_w) {
    Point p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = to_grid(on_line[i] + by_u * u[i] + by_w * w[i]);
    return p;
  };
  for (const double side : {-1.0, 1.0}) {
    const double beside = side * random.between(1, 16) / 16.0;
    const Point a = at(-in(2, 8), beside), b = at(in(2, 8), beside);
    add(scene.mesh, a, b, at(in(-4, 4), beside + side * in(4, 12)));
  }
}

// 3 to 6 long triangles about a window, each under the next, as the blades of an iris, and one to three triangles behind it. The long edge of each is seen at the window alone, and
// would be cut there by the wedge of the next (T12). The dial is the number of blades, and whether they are bent at the long edges. Every other eight scenes have one or two slits between the
// cell and the window.
GeneratedScene irises(std::uint64_t seed, std::uint64_t index) {
  Random random = random_of(seed, index, 12);
  const int blades = 3 + dial_of(index) % 4;
  const auto to_grid = [](double x) { return std::nearbyint(16 * x) / 16; };
  const auto axis = static_cast<std::size_t>(random.between(0, 2));  // along which the window is looked through
  const auto point = [&](double x, double y, double z) {
    Point p;
    p[(axis + 1) % 3] = to_grid(x);
    p[(axis + 2) % 3] = to_grid(y);
    p[axis] = to_grid(z);
    return p;
  };
  GeneratedScene scene;
  const double first = random.between(0, 99) / 100.0;
  for (int k = 0; k < blades; ++k) {
    const double turn = 2 * std::numbers::pi * (k + first + random.between(-10, 10) / 100.0) / blades;
    const double c = std::cos(turn), s = std::sin(turn);
    // u along the long edge, w away from the window.
    const auto at = [&](double u, double w, double z) { return point(c * u + s * w, s * u - c * w, z); };
    const double beside = random.between(4, 12) / 8.0, begin = -beside - random.between(2, 8),
                 end = random.between(8, 24), upper = random.between(2, 16) / 8.0, lower = -random.between(2, 16) / 8.0,
                 away = random.between(20, 40);
    const Point a = at(begin, beside, upper), b = at(end, beside, lower);
    add(scene.mesh, a, b, at(begin - random.between(0, 20), away, upper));
    if (dial_of(index) >= 4)
      add(scene.mesh, b, a, at(begin, beside + random.between(1, 8), upper + random.between(1, 8)));
  }
  for (int n = random.between(1, 3); n > 0; --n) {
    const double depth = -random.between(24, 64) / 8.0;
    const auto corner = [&] {
      const double x = random.between(-48, 48) / 8.0, y = random.between(-48, 48) / 8.0;
      return point(x, y, depth + random.between(-4, 4) / 8.0);
    };
    const Point a = corner(), b = corner(), c = corner();
    add(scene.mesh, a, b, c);
  }
  // A cell of any dimension.
  const double x = random.between(-16, 16) / 8.0, y = random.between(-16, 16) / 8.0, z = random.between(8, 30);
  const int dimension = random.between(0, 3);
  const auto size = [&](int least_dimension) {
    const double extent = random.between(1, 16) / 16.0;
    return dimension >= least_dimension ? extent : 0.0;
  };
  const double dx = size(1), dy = size(2), dz = size(3);
  scene.cell = distinct_corners(point(x, y, z), point(x + dx, y + dy, z + dz));
  if (index / dials % 2 == 1) {
    const Point& from = any(scene.cell, random);  // towards the middle of the window, which is the origin
    for (int n = random.between(1, 2); n > 0; --n) {
      const double t = random.between(3, 13) / 16.0;
      add_slit(scene, random, {t * from[0], t * from[1], t * from[2]}, from);
    }
  }
  return scene;
}

}  // namespace

const std::vector<DegenerateGenerator>& degenerate_generators() {
  static const std::vector<DegenerateGenerator> all{
      {"slivers",
       "triangles of next to no width (dial: none, an ulp, 2^-40 to 2^-10) between vertices of another scene", slivers},
      {"duplicates", "1 to 8 triangles (dial) twice, also turned over", duplicates},
      {"ulp_perturbed", "an exactly degenerate scene with 1 to 8 coordinates (dial) one ulp off", ulp_perturbed},
      {"scaled_and_moved", "scales from 2^-80 to 2^80 (dial), offsets up to 2^47 scene units", scaled_and_moved},
      {"cyclic_overlap", "3 to 8 bars (dial), each in front of the next", cyclic_overlap},
      {"nearly_closed", "panels that meet (dial 0), or overlap and gape by one ulp (1) or 2^-40 to 2^-10",
       nearly_closed},
      {"t_junctions", "walls whose columns are cut differently, with cracks of nothing, an ulp, 2^-40 to 2^-10 (dial)",
       t_junctions},
      {"coplanar_walls", "2 to 9 grid-aligned rectangles (dial) in common planes, the cell's faces among them",
       coplanar_walls},
      {"touching_cells", "cells with a vertex inside, on a face, an edge or a corner (dial modulo 4)", touching_cells},
      {"flat_cells", "points, segments and polygons as cells", flat_cells},
      {"thin_gaps",
       "rectangles flush with the cell's sides; gaps, steps and cells 1 to 2^-28 as wide as the rest (dial)",
       thin_gaps},
      {"irises",
       "3 to 6 long plates (dial modulo 4) about a window, each under the next; bent ones (dial 4 to 7); slits before "
       "them",
       irises},
      {"grooves_on_cells",
       "walls that meet in a line which the cell touches, with and without notches; something 1/2 to 2^-8 (dial) "
       "inside",
       grooves_on_cells},
      {"grooves_with_lids", "the same, with something that closes the ends of the walls, or does not quite",
       grooves_with_lids},
      {"floors_under_cells",
       "cells in the plane of a floor, walls on its seams, small triangles right above and below; of those many (dial "
       "4 "
       "to 7)",
       floors_under_cells}};
  return all;
}

}  // namespace clues::fuzz
