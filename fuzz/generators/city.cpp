// The city generator: plan first (all numbers in quarter metres), then one surface from the plan.
#include "fuzz/generators/city.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "fuzz/generators/grid_mesh.h"
#include "fuzz/generators/random.h"

namespace clues::fuzz {
namespace {

constexpr int quarter = 4;  // grid units in a metre
constexpr int wall = 1;     // thickness of the walls of a building with a room
constexpr std::int64_t plain_cost = 10,
                       room_cost = 62;  // triangles; a room also costs two of the street before its door

struct Building {
  int height = 0;
  bool room = false;
  int facing = 0;                      // the facade's side: 0 low y, 1 high x, 2 high y, 3 low x
  int door[2] = {0, 0}, door_top = 0;  // along the facade, from its left end seen from outside
  int window[2] = {0, 0}, window_z[2] = {0, 0};
};

struct Plan {
  std::vector<int> x, y;  // lines: street edge, building, street, building, ..., street edge
  std::vector<Building> buildings;
  int columns = 0, rows = 0;
  const Building& at(int i, int j) const { return buildings[static_cast<std::size_t>(j * columns + i)]; }
};

// The grid and the number of rooms that come closest to the wanted size, preferring one room in ten buildings.
void choose_size(std::int64_t triangles, int& columns, int& rows, std::int64_t& rooms) {
  std::int64_t best = -1;
  for (std::int64_t r = 1; r == 1 || 16 * r * r <= triangles; ++r) {
    for (std::int64_t c = r; c <= 2 * r + 1; ++c) {
      const std::int64_t n = c * r;
      const std::int64_t base = 2 * ((2 * c + 1) * (2 * r + 1) - n) + plain_cost * n;
      const std::int64_t extra = room_cost - plain_cost;
      const std::int64_t k = std::clamp((triangles - base + extra / 2) / extra, std::int64_t{0}, n);
      const std::int64_t miss = std::abs(base + extra * k - triangles);
      const std::int64_t cost =
          miss * 1000 / std::max(triangles, std::int64_t{1}) + std::abs(10 * k - n) * 50 / (10 * n);
      if (best < 0 || cost < best) {
        best = cost;
        columns = static_cast<int>(c);
        rows = static_cast<int>(r);
        rooms = k;
      }
    }
  }
}

std::vector<int> lines(Random& random, int blocks) {
  std::vector<int> at{0};
  for (int i = 0; i < blocks; ++i) {
    at.push_back(at.back() + random.between(3, 6) * quarter);             // street
    at.push_back(at.back() + random.between(6 * quarter, 12 * quarter));  // building
  }
  at.push_back(at.back() + random.between(3, 6) * quarter);
  return at;
}

Plan make_plan(std::uint32_t triangles, std::uint64_t seed) {
  Plan plan;
  std::int64_t rooms = 0;
  choose_size(triangles, plan.columns, plan.rows, rooms);
  Random random(seed);
  plan.x = lines(random, plan.columns);
  plan.y = lines(random, plan.rows);
  const std::int64_t n = std::int64_t{plan.columns} * plan.rows;
  for (std::int64_t i = 0; i < n; ++i) {
    Building b;
    b.height = random.between(3 * quarter, 24 * quarter);
    b.room = (i + 1) * rooms / n != i * rooms / n;
    b.facing = random.between(0, 3);
    b.door[0] = random.between(3, 5);
    b.door[1] = b.door[0] + random.between(4, 6);
    b.door_top = random.between(8, 9);
    b.window[0] = random.between(13, 15);
    b.window[1] = b.window[0] + random.between(3, 7);
    b.window_z[0] = random.between(3, 4);
    b.window_z[1] = b.window_z[0] + random.between(3, 5);
    plan.buildings.push_back(b);
  }
  return plan;
}

// Facade coordinates: u along the facade, v into the building, z up. Turning keeps the orientation.
class Lot {
 public:
  Lot(const Plan& plan, int i, int j) : building(plan.at(i, j)) {
    const auto a = static_cast<std::size_t>(2 * i + 1), b = static_cast<std::size_t>(2 * j + 1);
    x0_ = plan.x[a];
    x1_ = plan.x[a + 1];
    y0_ = plan.y[b];
    y1_ = plan.y[b + 1];
  }
  int width() const { return building.facing % 2 == 0 ? x1_ - x0_ : y1_ - y0_; }
  int depth() const { return building.facing % 2 == 0 ? y1_ - y0_ : x1_ - x0_; }
  GridPoint at(int u, int v, int z) const {
    switch (building.facing) {
      case 0:
        return {x0_ + u, y0_ + v, z};
      case 1:
        return {x1_ - v, y0_ + u, z};
      case 2:
        return {x1_ - u, y1_ - v, z};
      default:
        return {x0_ + v, y1_ - u, z};
    }
  }
  const Building& building;

 private:
  int x0_, x1_, y0_, y1_;
};

void add_plain(GridMesh& mesh, const Lot& lot) {
  const int w = lot.width(), d = lot.depth(), h = lot.building.height;
  const GridPoint a = lot.at(0, 0, 0), b = lot.at(w, 0, 0), c = lot.at(w, d, 0), e = lot.at(0, d, 0);
  const auto up = [&](GridPoint p) { return GridPoint{p[0], p[1], p[2] + h}; };
  mesh.quad(a, b, up(b), up(a));
  mesh.quad(b, c, up(c), up(b));
  mesh.quad(c, e, up(e), up(c));
  mesh.quad(e, a, up(a), up(e));
  mesh.quad(up(a), up(b), up(c), up(e));
}

// The wall with the door and the window, from u0 to u1 and up to `top`, at depth v; seen from the street, or (inner) from the room.
// The window is joined to the outline by a doubled edge from the door's upper right corner.
void add_facade(GridMesh& mesh, const Lot& lot, int u0, int u1, int top, int v, bool inner) {
  const Building& b = lot.building;
  std::vector<GridPoint2> flat{{u0, 0},
                               {b.door[0], 0},
                               {b.door[0], b.door_top},
                               {b.door[1], b.door_top},
                               {b.window[0], b.window_z[1]},
                               {b.window[1], b.window_z[1]},
                               {b.window[1], b.window_z[0]},
                               {b.window[0], b.window_z[0]},
                               {b.window[0], b.window_z[1]},
                               {b.door[1], b.door_top},
                               {b.door[1], 0},
                               {u1, 0},
                               {u1, top},
                               {u0, top}};
  std::vector<GridPoint> corners;
  for (const GridPoint2& p : flat) {
    corners.push_back(lot.at(p[0], v, p[1]));
  }
  if (inner) {  // seen from the other side
    std::reverse(flat.begin(), flat.end());
    std::reverse(corners.begin(), corners.end());
    for (GridPoint2& p : flat) {
      p[0] = -p[0];
    }
  }
  mesh.polygon(corners, flat);
}

void add_room(GridMesh& mesh, const Lot& lot) {
  const Building& b = lot.building;
  const int w = lot.width(), d = lot.depth(), h = b.height, t = wall;
  const auto at = [&](int u, int v, int z) { return lot.at(u, v, z); };
  // Outside: facade, three walls, roof.
  add_facade(mesh, lot, 0, w, h, 0, false);
  mesh.quad(at(w, 0, 0), at(w, d, 0), at(w, d, h), at(w, 0, h));
  mesh.quad(at(w, d, 0), at(0, d, 0), at(0, d, h), at(w, d, h));
  mesh.quad(at(0, d, 0), at(0, 0, 0), at(0, 0, h), at(0, d, h));
  mesh.quad(at(0, 0, h), at(w, 0, h), at(w, d, h), at(0, d, h));
  // Inside, facing the room: the same with the other orientation.
  const int l = t, r = w - t, n = t, f = d - t, c = h - t;
  add_facade(mesh, lot, l, r, c, n, true);
  mesh.quad(at(r, n, 0), at(r, n, c), at(r, f, c), at(r, f, 0));
  mesh.quad(at(r, f, 0), at(r, f, c), at(l, f, c), at(l, f, 0));
  mesh.quad(at(l, f, 0), at(l, f, c), at(l, n, c), at(l, n, 0));
  mesh.quad(at(l, n, c), at(l, f, c), at(r, f, c), at(r, n, c));
  const int d0 = b.door[0], d1 = b.door[1], dz = b.door_top;
  mesh.polygon({at(l, n, 0), at(d0, n, 0), at(d1, n, 0), at(r, n, 0), at(r, f, 0), at(l, f, 0)},
               {{l, n}, {d0, n}, {d1, n}, {r, n}, {r, f}, {l, f}});
  // The doorway: threshold, jambs, lintel.
  mesh.quad(at(d0, 0, 0), at(d1, 0, 0), at(d1, n, 0), at(d0, n, 0));
  mesh.quad(at(d0, 0, 0), at(d0, n, 0), at(d0, n, dz), at(d0, 0, dz));
  mesh.quad(at(d1, 0, 0), at(d1, 0, dz), at(d1, n, dz), at(d1, n, 0));
  mesh.quad(at(d0, 0, dz), at(d0, n, dz), at(d1, n, dz), at(d1, 0, dz));
  // The window: sill, jambs, lintel.
  const int w0 = b.window[0], w1 = b.window[1], z0 = b.window_z[0], z1 = b.window_z[1];
  mesh.quad(at(w0, 0, z0), at(w1, 0, z0), at(w1, n, z0), at(w0, n, z0));
  mesh.quad(at(w0, 0, z0), at(w0, n, z0), at(w0, n, z1), at(w0, 0, z1));
  mesh.quad(at(w1, 0, z0), at(w1, 0, z1), at(w1, n, z1), at(w1, n, z0));
  mesh.quad(at(w0, 0, z1), at(w0, n, z1), at(w1, n, z1), at(w1, 0, z1));
}

// One rectangle of street; a door on one of its sides puts two more vertices there.
void add_ground(GridMesh& mesh, const Plan& plan, int i, int j) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const int x0 = plan.x[a], x1 = plan.x[a + 1], y0 = plan.y[b], y1 = plan.y[b + 1];
  std::vector<GridPoint2> outline;
  // The building beyond the side (di,dj) has its door there when it faces this way. Its door runs against our sense.
  const auto door = [&](int di, int dj, int facing) {
    const int m = i + di, n = j + dj;
    const bool lot = m % 2 == 1 && n % 2 == 1 && m > 0 && n > 0 && m < 2 * plan.columns + 1 && n < 2 * plan.rows + 1;
    if (!lot || !plan.at(m / 2, n / 2).room || plan.at(m / 2, n / 2).facing != facing) {
      return;
    }
    const Lot house(plan, m / 2, n / 2);
    for (const int k : {1, 0}) {
      const GridPoint p = house.at(house.building.door[k], 0, 0);
      outline.push_back({p[0], p[1]});
    }
  };
  outline.push_back({x0, y0});
  door(0, -1, 2);
  outline.push_back({x1, y0});
  door(1, 0, 3);
  outline.push_back({x1, y1});
  door(0, 1, 0);
  outline.push_back({x0, y1});
  door(-1, 0, 1);
  std::vector<GridPoint> corners;
  for (const GridPoint2& p : outline) {
    corners.push_back({p[0], p[1], 0});
  }
  mesh.polygon(corners, outline);
}

}  // namespace

scene::TriangleMesh make_city(std::uint32_t triangles, std::uint64_t seed) {
  const Plan plan = make_plan(triangles, seed);
  GridMesh mesh(quarter);
  for (int j = 0; j < 2 * plan.rows + 1; ++j) {
    for (int i = 0; i < 2 * plan.columns + 1; ++i) {
      if (i % 2 == 0 || j % 2 == 0) {
        add_ground(mesh, plan, i, j);
        continue;
      }
      const Lot lot(plan, i / 2, j / 2);
      if (lot.building.room) {
        add_room(mesh, lot);
      } else {
        add_plain(mesh, lot);
      }
    }
  }
  return std::move(mesh).take();
}

std::vector<scene::Point> street_cell(std::uint32_t triangles, std::uint64_t seed) {
  const Plan plan = make_plan(triangles, seed);
  // The street before the middle column, beside the middle row's building; a quarter metre from its wall.
  const auto column = static_cast<std::size_t>(2 * (plan.columns / 2)),
             row = static_cast<std::size_t>(2 * (plan.rows / 2) + 1);
  const int x1 = plan.x[column + 1] - 1, y0 = (plan.y[row] + plan.y[row + 1]) / 2 - 4;
  const GridMesh scale(quarter);
  std::vector<scene::Point> corners;
  for (const GridPoint& p : box_corners({x1 - 4, y0, 6}, {x1, y0 + 8, 7})) {
    corners.push_back(scale.scaled(p));
  }
  return corners;
}

}  // namespace clues::fuzz
