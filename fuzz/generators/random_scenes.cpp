// The random scenes of the fuzzer: one function per kind, all in sixteenths, the cell on the low-x side.
#include "fuzz/generators/random_scenes.h"

#include <algorithm>
#include <utility>

#include "fuzz/generators/grid_mesh.h"
#include "fuzz/generators/random.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

constexpr int unit = 16;

GridPoint random_point(Random& random, const GridPoint& lo, const GridPoint& hi) {
  return {random.between(lo[0], hi[0]), random.between(lo[1], hi[1]), random.between(lo[2], hi[2])};
}

void add_loose_triangle(GridMesh& mesh, Random& random, const GridPoint& lo, const GridPoint& hi, int reach) {
  GridPoint a, b, c;
  do {
    a = random_point(random, lo, hi);
    const GridPoint low{a[0] - reach / 2, a[1] - reach, a[2] - reach},
        high{a[0] + reach / 2, a[1] + reach, a[2] + reach};
    b = random_point(random, low, high);
    c = random_point(random, low, high);
  } while (collinear(a, b, c));
  mesh.triangle(a, b, c);
}

void add_tetrahedron(GridMesh& mesh, Random& random, const GridPoint& lo, const GridPoint& hi) {
  GridPoint a, b, c, d;
  do {
    a = random_point(random, lo, hi);
    b = random_point(random, lo, hi);
    c = random_point(random, lo, hi);
    d = random_point(random, lo, hi);
  } while (volume(a, b, c, d) == 0);
  if (volume(a, b, c, d) < 0) {
    std::swap(c, d);
  }
  mesh.triangle(a, c, b);
  mesh.triangle(a, b, d);
  mesh.triangle(b, c, d);
  mesh.triangle(a, d, c);
}

// Disjoint slots of a 3 x 2 x 2 grid in random order, with a gap of two sixteenths between them.
std::vector<std::pair<GridPoint, GridPoint>> slots(Random& random) {
  std::vector<std::pair<GridPoint, GridPoint>> all;
  for (int i = 0; i < 12; ++i) {
    const GridPoint lo{(i % 3) * 3 * unit, (i / 3 % 2) * 4 * unit, (i / 6) * 4 * unit};
    all.push_back({lo, {lo[0] + 3 * unit - 2, lo[1] + 4 * unit - 2, lo[2] + 4 * unit - 2}});
  }
  for (int i = 11; i > 0; --i) {
    std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(random.between(0, i))]);
  }
  return all;
}

void add_sheet(GridMesh& mesh, Random& random, int x, int columns, int rows) {
  const int step_y = random.between(1, 2) * unit, step_z = random.between(1, 2) * unit;
  const int y0 = random.between(0, 3 * unit), z0 = random.between(0, 3 * unit);
  std::vector<GridPoint> points;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      points.push_back({x + random.between(0, 24), y0 + i * step_y + random.between(-4, 4),
                        z0 + j * step_z + random.between(-4, 4)});
    }
  }
  const auto at = [&](int i, int j) { return points[static_cast<std::size_t>(j * (columns + 1) + i)]; };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const bool hole = i != 0 && j != 0 && random.one_in(8);
      const bool flip = random.one_in(2);
      const GridPoint a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (!hole && flip) {
        mesh.triangle(a, b, c);
        mesh.triangle(a, c, d);
      } else if (!hole) {
        mesh.triangle(b, c, d);
        mesh.triangle(b, d, a);
      }
    }
  }
}

void add_axis_boxes(GridMesh& mesh, Random& random) {
  const int wanted = random.between(1, 4), height = random.between(1, 3), gap = random.one_in(3) ? 0 : 1;
  std::vector<std::pair<GridPoint, GridPoint>> boxes;
  for (int tries = 0; tries < 60 && static_cast<int>(boxes.size()) < wanted; ++tries) {
    const GridPoint lo{random.between(0, 5), random.between(0, 5), random.one_in(3) ? random.between(1, 3) : 0};
    const GridPoint hi{lo[0] + random.between(1, 3), lo[1] + random.between(1, 3),
                       lo[2] + (random.one_in(2) ? height : random.between(1, 4))};
    const bool free = std::none_of(boxes.begin(), boxes.end(), [&](const auto& other) {
      bool apart = false;
      for (std::size_t i = 0; i < 3; ++i) {
        apart = apart || hi[i] + gap <= other.first[i] || other.second[i] + gap <= lo[i];
      }
      return !apart;
    });
    if (free) {
      boxes.push_back({lo, hi});
    }
  }
  for (auto [lo, hi] : boxes) {
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] *= unit;
      hi[i] *= unit;
    }
    mesh.box(lo, hi);
  }
}

// Outlines in sixteenths inside [0,46] x [0,46], counter-clockwise.
std::vector<GridPoint2> random_outline(Random& random) {
  const int a = random.between(8, 20), b = random.between(26, 38), c = random.between(8, 30),
            w = random.between(40, 46);
  switch (random.between(0, 3)) {
    case 0:  // L
      return {{0, 0}, {w, 0}, {w, a}, {b - a / 2, a}, {b - a / 2, w}, {0, w}};
    case 1:  // U
      return {{0, 0}, {w, 0}, {w, w}, {b, w}, {b, c}, {a, c}, {a, random.between(32, 46)}, {0, 32}};
    case 2:  // a notch
      return {{0, 0}, {w, 0}, {w, w}, {b, w}, {(a + b) / 2, c}, {a, w}, {0, w}};
    default:  // a star of four points
      return {{23 - a / 4, 23 - a / 4}, {23, 0},
              {23 + a / 4, 23 - a / 4}, {46, 23},
              {23 + a / 4, 23 + a / 4}, {23, b > 32 ? 46 : 40},
              {23 - a / 4, 23 + a / 4}, {0, 23}};
  }
}

void add_prism(GridMesh& mesh, Random& random, const GridPoint& lo) {
  const std::vector<GridPoint2> outline = random_outline(random);
  const int depth = random.between(6, 46);
  const auto axis = static_cast<std::size_t>(random.between(0, 2));  // a cyclic exchange of axes keeps the orientation
  const auto place = [&](const GridPoint2& p, int h) {
    GridPoint q{};
    q[axis] = lo[axis] + h;
    q[(axis + 1) % 3] = lo[(axis + 1) % 3] + p[0];
    q[(axis + 2) % 3] = lo[(axis + 2) % 3] + p[1];
    return q;
  };
  for (const auto& t : triangulate(outline)) {
    mesh.triangle(place(outline[t[0]], depth), place(outline[t[1]], depth), place(outline[t[2]], depth));
    mesh.triangle(place(outline[t[0]], 0), place(outline[t[2]], 0), place(outline[t[1]], 0));
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const GridPoint2 &p = outline[i], &q = outline[(i + 1) % outline.size()];
    mesh.quad(place(p, 0), place(q, 0), place(q, depth), place(p, depth));
  }
}

void add_wall(GridMesh& mesh, Random& random) {
  const GridPoint lo = mesh.lowest(), hi = mesh.highest();
  const int x = hi[0] + random.between(1, 4) * unit, m = random.between(1, 3) * unit;
  mesh.quad({x, lo[1] - m, lo[2] - m}, {x, lo[1] - m, hi[2] + m}, {x, hi[1] + m, hi[2] + m}, {x, hi[1] + m, lo[2] - m});
}

// In front of everything on the low-x side. Now and then it touches the lowest vertex, or is flat.
std::vector<GridPoint> random_cell(const GridMesh& mesh, Random& random, bool axis_aligned) {
  const GridPoint low = mesh.lowest(), high = mesh.highest();
  const int grain = axis_aligned ? unit : 1;
  const auto pick = [&](int lo, int hi) {
    return random.between(lo / grain, std::max(lo / grain, hi / grain)) * grain;
  };
  const int gap = random.one_in(6) ? 0 : std::max(grain, pick(8, 2 * unit));
  GridPoint hi{low[0] - gap, pick(low[1] + unit, high[1]), pick(low[2] + unit, high[2])};
  GridPoint lo{hi[0] - std::max(grain, pick(6, 3 * unit)), hi[1] - std::max(grain, pick(6, 5 * unit)),
               hi[2] - std::max(grain, pick(6, 3 * unit))};
  if (random.one_in(12)) {
    const auto flat = static_cast<std::size_t>(random.between(0, 2));
    lo[flat] = hi[flat];
  }
  if (axis_aligned || !random.one_in(3)) {
    return box_corners(lo, hi);
  }
  std::vector<GridPoint> points{{hi[0], random.between(lo[1], hi[1]), random.between(lo[2], hi[2])}};
  for (int n = random.between(3, 6); n > 0; --n) {
    points.push_back(random_point(random, lo, hi));
  }
  return points;
}

void fill(GridMesh& mesh, Random& random, Kind kind) {
  const GridPoint lo{0, 0, 0}, hi{6 * unit, 8 * unit, 8 * unit};
  switch (kind) {
    case Kind::loose_triangles:
      for (int n = random.between(4, 40); n > 0; --n) {
        add_loose_triangle(mesh, random, lo, hi, random.between(1, 4) * unit);
      }
      return;
    case Kind::tetrahedra: {
      const auto places = slots(random);
      for (int n = random.between(1, 11); n > 0; --n) {
        add_tetrahedron(mesh, random, places[static_cast<std::size_t>(n)].first,
                        places[static_cast<std::size_t>(n)].second);
      }
      return;
    }
    case Kind::open_sheets: {
      const int sheets = random.between(1, 3);
      for (int n = 0; n < sheets; ++n) {
        const int columns = random.between(2, 3), rows = random.between(2, 3);
        add_sheet(mesh, random, n * 3 * unit, columns, rows);
      }
      return;
    }
    case Kind::axis_boxes:
      add_axis_boxes(mesh, random);
      return;
    case Kind::interpenetrating: {
      const GridPoint near{2 * unit, 2 * unit, 2 * unit}, far{5 * unit, 6 * unit, 6 * unit};
      for (int n = random.between(0, 4); n > 0; --n) {
        add_tetrahedron(mesh, random, near, far);
      }
      for (int n = random.between(4, 14); n > 0; --n) {
        add_loose_triangle(mesh, random, near, far, 4 * unit);
      }
      return;
    }
    case Kind::nonconvex_solids: {
      const auto places = slots(random);
      for (int n = random.between(1, 2); n > 0; --n) {
        add_prism(mesh, random, places[static_cast<std::size_t>(n)].first);
      }
      return;
    }
  }
  throw scene::Error(scene::ErrorCode::bad_argument, "unknown kind of random scene");
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::loose_triangles:
      return "loose_triangles";
    case Kind::tetrahedra:
      return "tetrahedra";
    case Kind::open_sheets:
      return "open_sheets";
    case Kind::axis_boxes:
      return "axis_boxes";
    case Kind::interpenetrating:
      return "interpenetrating";
    case Kind::nonconvex_solids:
      return "nonconvex_solids";
  }
  throw scene::Error(scene::ErrorCode::bad_argument, "unknown kind of random scene");
}

GeneratedScene generate(Kind kind, std::uint64_t seed, std::uint64_t index) {
  // Hash the three numbers one after the other, so that near seeds and indices share nothing.
  Random random(Random(Random(seed).next() ^ index).next() ^ static_cast<std::uint64_t>(kind));
  random = Random(random.next());
  GridMesh mesh(unit);
  fill(mesh, random, kind);
  const std::vector<GridPoint> cell = random_cell(mesh, random, kind == Kind::axis_boxes);
  if (!random.one_in(4) && mesh.size() <= 58) {
    add_wall(mesh, random);
  }
  GeneratedScene scene;
  scene.name = std::string(name_of(kind)) + "-" + std::to_string(seed) + "-" + std::to_string(index);
  for (const GridPoint& p : cell) {
    scene.cell.push_back(mesh.scaled(p));
  }
  scene.mesh = std::move(mesh).take();
  return scene;
}

}  // namespace clues::fuzz
