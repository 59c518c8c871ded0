#include "fuzz/generators/touching_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fuzz/generators/cell_shapes.h"
#include "fuzz/generators/parts.h"

namespace clues::fuzz {
namespace {

using scene::Point;

// A scene about a cell, and the places at it.
class Builder {
 public:
  Builder(std::uint64_t seed, std::uint64_t index, std::uint64_t salt)
      : random_(random_of(seed, index, salt)), cell_(cell_shape(dial_of(index) % cell_kinds, random_)) {
    // Few triangles are the normal case, one alone is not: 1 to 10, half of the scenes at most 4.
    if (!random_.one_in(12)) triangles_ = static_cast<std::size_t>(2 + random_.between(0, random_.between(1, 8)));
  }

  Random& random() { return random_; }
  bool full() const { return mesh_.triangles.size() >= triangles_; }
  int dimension() const { return cell_.dimension; }

  // Anywhere about the cell.
  Point free() {
    Point p;
    for (double& x : p) x = random_.between(-5, 6);
    return p;
  }
  Point direction() {
    Point d{};
    while (d == Point{}) {
      for (double& x : d) x = random_.between(-2, 2);
    }
    return d;
  }
  // So many steps away from q, in any direction.
  Point beside(const Point& q, int least, int most) {
    const Point d = direction();
    return plus(q, d, random_.between(least, most));
  }
  Point corner() { return any(cell_.vertices, random_); }
  // Inside an edge, at a quarter of it.
  Point on_edge() {
    if (cell_.edges.empty()) return corner();
    const auto& [a, b] = any(cell_.edges, random_);
    return along(cell_.vertices[a], cell_.vertices[b], random_.between(1, 3) / 4.0);
  }
  // Beyond the ends of an edge, or on them.
  Point in_line() {
    if (cell_.edges.empty()) return beside(corner(), 1, 1);
    const auto& [a, b] = any(cell_.edges, random_);
    const double t = random_.between(1, 3);
    return along(cell_.vertices[a], cell_.vertices[b], random_.one_in(2) ? t : 1 - t);
  }
  Point on_face() {
    if (cell_.faces.empty()) return on_edge();
    return mixed(any(cell_.faces, random_));
  }
  // In the plane of a face, mostly beside it.
  Point in_plane() { return in_plane_of(some_face()); }
  Point inside() {
    if (cell_.dimension < 3) return cell_.dimension == 2 ? on_face() : on_edge();
    std::vector<std::size_t> all(cell_.vertices.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return mixed(all);
  }
  // On the rim of the cell, or inside it.
  Point contact() {
    switch (random_.between(0, 4)) {
      case 0:
        return corner();
      case 1:
        return on_edge();
      case 2:
        return on_face();
      case 3:
        return inside();
      default:
        return random_.one_in(2) ? in_line() : corner();
    }
  }
  Point any_place() {
    switch (random_.between(0, 5)) {
      case 0:
        return contact();
      case 1:
        return in_line();
      case 2:
        return in_plane();
      case 3:
        if (!mesh_.points.empty()) return any(mesh_.points, random_);
        [[fallthrough]];
      default:
        return free();
    }
  }
  // Three points that span the plane of a face; a cell without faces gets any plane through it, the same for as long as it is asked about.
  std::array<Point, 3> some_face() {
    if (!cell_.faces.empty()) {
      const auto& face = any(cell_.faces, random_);
      return {cell_.vertices[face[0]], cell_.vertices[face[1]], cell_.vertices[face[2]]};
    }
    const Point a = cell_.vertices.front(), b = cell_.edges.empty() ? beside(a, 1, 1) : cell_.vertices.back();
    return {a, b, beside(a, 1, 1)};
  }
  Point in_plane_of(const std::array<Point, 3>& face) {
    const double s = random_.between(-4, 4) / 2.0, t = random_.between(-4, 4) / 2.0;
    Point p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = face[0][i] + s * (face[1][i] - face[0][i]) + t * (face[2][i] - face[0][i]);
    return p;
  }

  static Point plus(const Point& p, const Point& d, double by) {
    return {p[0] + by * d[0], p[1] + by * d[1], p[2] + by * d[2]};
  }
  static Point along(const Point& a, const Point& b, double t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  }

  // Nothing where the three are on a line. (Corners in braces are made from left to right, with any compiler.)
  struct Corners {
    Point a, b, c;
  };
  void add(const Corners& t) {
    const auto& [a, b, c] = t;
    const Point u = plus(b, a, -1), w = plus(c, a, -1);
    const bool area = u[1] * w[2] != u[2] * w[1] || u[2] * w[0] != u[0] * w[2] || u[0] * w[1] != u[1] * w[0];
    if (area) fuzz::add(mesh_, a, b, c);
  }
  // A triangle that goes on from an edge that is there.
  void grow() {
    if (mesh_.triangles.empty()) return;
    const auto& t = any(mesh_.triangles, random_);
    const auto i = static_cast<std::size_t>(random_.between(0, 2));
    const Point a = mesh_.points[t[i]], b = mesh_.points[t[(i + 1) % 3]];
    add({a, b, any_place()});
  }
  // One that is there already, turned over every other time, or overlapping it in its plane.
  void repeat() {
    if (mesh_.triangles.empty()) return;
    const scene::Triangle& t = any(mesh_.triangles, random_);
    const Point a = mesh_.points[t[0]], b = mesh_.points[t[1]], c = mesh_.points[t[2]];
    if (random_.one_in(2)) {
      random_.one_in(2) ? add({a, c, b}) : add({a, b, c});
    } else {
      add({along(a, b, 0.5), along(a, c, 0.5), along(b, c, random_.one_in(2) ? 2.0 : -0.5)});
    }
  }

  // Until there are as many triangles as meant: what `make` adds, and now and then what is on any mesh or beside it.
  template <class Make>
  GeneratedScene filled_by(const Make& make) {
    for (int tries = 0; !full() && tries < 200; ++tries) {
      const int kind = mesh_.triangles.empty() ? 0 : random_.between(0, 9);
      if (kind <= 5) {
        make(*this);
      } else if (kind <= 7) {
        add({free(), free(), free()});
      } else if (kind == 8) {
        grow();
      } else {
        repeat();
      }
    }
    while (mesh_.triangles.empty()) add({free(), free(), free()});
    GeneratedScene scene;
    scene.mesh = std::move(mesh_);
    scene.cell = std::move(cell_.vertices);
    return scene;
  }

 private:
  // A point inside the hull of these, in sixteenths.
  Point mixed(const std::vector<std::size_t>& corners) {
    std::vector<int> weights(corners.size(), 1);
    for (int left = 16 - static_cast<int>(corners.size()); left > 0;) {
      const int part = random_.one_in(3) ? left : random_.between(1, left);
      any(weights, random_) += part;
      left -= part;
    }
    Point p{};
    for (std::size_t k = 0; k < corners.size(); ++k) p = plus(p, cell_.vertices[corners[k]], weights[k] / 16.0);
    return p;
  }

  Random random_;
  CellShape cell_;
  std::size_t triangles_ = 1;
  scene::TriangleMesh mesh_;
};

// Triangles about one vertex that is on the cell; they share edges, or leave gaps.
void fan(Builder& b) {
  const Point apex = b.contact();
  Point last = b.free();
  const bool flat = b.random().one_in(4);
  const auto face = b.some_face();
  for (int n = b.random().between(1, 5); n > 0 && !b.full(); --n) {
    const Point next = flat ? b.in_plane_of(face) : b.random().one_in(5) ? b.any_place() : b.free();
    b.add({apex, last, next});
    last = b.random().one_in(5) ? b.free() : next;
  }
}

// An edge on the cell, or on it and beyond its rim; the third corner off it.
void standing(Builder& b) { b.add({b.contact(), b.contact(), b.random().one_in(4) ? b.any_place() : b.free()}); }

// Corners on opposite sides of a point in the cell.
void crossing(Builder& b) {
  const Point q = b.contact(), d = b.direction(), e = b.direction();
  switch (b.random().between(0, 2)) {
    case 0:
      b.add({Builder::plus(q, d, -1), Builder::plus(q, d, b.random().between(1, 2)), b.free()});
      break;
    case 1:
      b.add({Builder::plus(q, d, 2), Builder::plus(q, e, 2), Builder::plus(Builder::plus(q, d, -1), e, -1)});
      break;
    default:
      b.add({Builder::plus(q, d, 4), Builder::plus(q, e, 4), Builder::plus(Builder::plus(q, d, -4), e, -4)});
  }
}

// In the plane of a face of the cell: beside it, touching it, over it.
void coplanar(Builder& b) {
  const auto face = b.some_face();
  const auto place = [&] { return b.random().one_in(3) ? b.in_plane_of(face) : any(face, b.random()); };
  b.add({b.in_plane_of(face), b.in_plane_of(face), b.random().one_in(2) ? place() : b.in_plane_of(face)});
}

// A mesh edge that leaves the cell.
void leaving(Builder& b) {
  const Point q = b.random().one_in(2) ? b.inside() : b.contact();
  const Point far = b.beside(q, 1, 3);
  b.add({q, far, b.free()});
  if (b.random().one_in(2) && !b.full()) b.add({q, far, b.random().one_in(3) ? b.in_plane() : b.free()});
}

// An edge outside of the cell whose line touches it, or is the line of one of its edges.
void pointing(Builder& b) {
  if (b.random().one_in(3)) {
    b.add({b.in_line(), b.in_line(), b.free()});
    return;
  }
  const Point q = b.contact(), d = b.direction();
  const int near = b.random().between(1, 2), far = near + b.random().between(1, 2);
  const Point a = Builder::plus(q, d, near), c = Builder::plus(q, d, far);
  const Point third = b.random().one_in(3) ? b.beside(b.contact(), 2, 2) : b.free();
  b.add({a, c, third});
  if (b.random().one_in(2) && !b.full()) b.add({c, a, b.free()});
}

void anywhere(Builder& b) { b.add({b.any_place(), b.any_place(), b.any_place()}); }

template <void (*Make)(Builder&), std::uint64_t Salt>
GeneratedScene made(std::uint64_t seed, std::uint64_t index) {
  return Builder(seed, index, Salt).filled_by(Make);
}

// Two walls, or more, that meet in a line upon the cell: one or two stretches of wall on each side of it (with a notch between them, or not), ends that are closed or open, something small inside.
class Grooves {
 public:
  enum class Ends : std::uint8_t { mostly_open, with_lids };
  Grooves(std::uint64_t seed, std::uint64_t index, Ends ends)
      : random_(random_of(seed, index, ends == Ends::with_lids ? 14 : 13)),
        depth_(std::ldexp(1, -1 - dial_of(index))),
        lids_(ends == Ends::with_lids) {}

  // The line is the first axis, the third leads into the groove; then all is turned and sheared.
  GeneratedScene make() {
    const bool joins = !random_.one_in(4);  // both walls in the same points of the line
    const int middle = random_.between(-1, 1) * random_.between(0, 1);
    for (const int side : {-1, 1}) add_wall(side, joins ? middle : random_.between(-1, 1));
    for (const int end : {-1, 1}) {
      if (lids_) {
        if (!random_.one_in(4)) add_lid(end);
      } else if (random_.one_in(6)) {
        add_across(end * random_.between(1, 3), random_.between(1, 2));
      }
    }
    add_inside();
    add_cell();
    turn();
    return std::move(scene_);
  }

 private:
  double quarter(int low, int high) { return random_.between(4 * low, 4 * high) / 4.0; }

  // From the left of the line to its right, in one triangle or two that meet in `middle`; what is between those is filled or not.
  void add_wall(int side, int middle) {
    const double lean = side * random_.between(1, 8) / 4.0;
    const auto up = [&](double x, double z) { return Point{x, lean * z, z}; };
    const Point left{lids_ ? -kLid : -quarter(2, 3), 0, 0}, right{lids_ ? kLid : quarter(2, 3), 0, 0},
        at{static_cast<double>(middle), 0, 0};
    if (random_.one_in(2)) return add(scene_.mesh, left, right, up(quarter(-2, 2), 1));
    const Point l = up(middle - random_.between(0, 6) / 4.0, 1), r = up(middle + random_.between(0, 6) / 4.0, 1);
    add(scene_.mesh, left, at, l);
    add(scene_.mesh, at, right, r);
    if (random_.one_in(2)) add(scene_.mesh, at, l, r);
  }

  // A triangle that stands across the groove, on the line.
  void add_across(double x, double height) {
    add(scene_.mesh, {x, 0, 0}, {x + quarter(-1, 1), 2 * height, height}, {x + quarter(-1, 1), -2 * height, height});
  }

  // Over both walls at their end, or over one of them and a little of the other; in one triangle or two; a little too high now and then.
  void add_lid(int end) {
    const double x = end * (random_.one_in(6) ? kLid + std::ldexp(1, -random_.between(2, 20)) : kLid);
    const Point foot{x, 0, 0};
    const auto far = [&](int side) {
      const double wide = random_.one_in(4) ? random_.between(-1, 2) / 2.0 : 2.5;
      return Point{x + quarter(-1, 1), side * wide, 1};
    };
    const Point left = far(-1), right = far(1);
    if (random_.one_in(2)) return add(scene_.mesh, foot, left, right);
    const Point middle{x + quarter(-1, 1), 0, 1.5};
    add(scene_.mesh, foot, left, middle);
    add(scene_.mesh, foot, middle, right);
  }

  void add_inside() {
    const double x = quarter(-2, 2);
    const auto corner = [&] {
      return Point{x + depth_ * random_.between(-4, 4) / 4, depth_ * random_.between(-2, 2) / 2,
                   depth_ * random_.between(1, 4) / 2};
    };
    const Point a = corner(), b = corner(), c = corner();
    add(scene_.mesh, a, b, c);
  }

  void add_cell() {
    const double reach = random_.one_in(4) ? 3 : 1.5;  // beyond the walls, or not as far
    const Point lo{-reach * random_.between(1, 4) / 4, 0, 0}, hi{reach * random_.between(1, 4) / 4, 0, 0};
    const double aside = random_.between(1, 4) / 2.0, below = random_.between(1, 4) / 2.0;
    const int kind = random_.between(0, 7);
    Point a = lo, b = hi;
    if (kind == 2 || kind == 3) {  // a side of a polygon, or an edge of a solid, is on the line
      b[1] = aside;
    } else if (kind != 1) {  // the line runs in a polygon, or on a face; 1 is a segment on it
      a[1] = -aside;
      b[1] = random_.between(1, 4) / 2.0;
    }
    if (kind == 3 || kind == 4) a[2] = -below;
    if (kind == 5) {  // a polygon next to the line
      b[1] = 0;
      a[2] = b[2] = -std::ldexp(1, -random_.between(1, 6));
    }
    scene_.cell = distinct_corners(a, b);
  }

  void turn() {
    const auto axes = shuffled_axes(random_);
    const bool mirror = random_.one_in(2);
    const int shear = random_.one_in(2) ? 0 : random_.between(-2, 2), along = random_.between(-1, 1);
    for (auto* points : {&scene_.mesh.points, &scene_.cell}) {
      for (Point& p : *points) {
        const Point q{p[0] + shear * p[1], p[1] + along * p[2], mirror ? -p[2] : p[2]};
        for (std::size_t i = 0; i < 3; ++i) p[axes[i]] = q[i];
      }
    }
  }

  Random random_;
  double depth_;
  bool lids_;
  GeneratedScene scene_;
  static constexpr double kLid = 2;  // where the walls end, if there are lids
};

}  // namespace

const std::vector<DegenerateGenerator>& touching_generators() {
  static const std::vector<DegenerateGenerator> all{
      {"rim_fans",
       "triangles about a vertex on the cell; in all of these the dial is the cell: point, segments, polygons, solids",
       made<fan, 31>},
      {"stands_on_cell", "triangles with an edge on the cell", made<standing, 32>},
      {"crosses_cell", "triangles that run through the cell, its edges and its corners", made<crossing, 33>},
      {"cell_planes", "triangles in the planes of the cell's faces, beside them and over them", made<coplanar, 34>},
      {"leaves_cell", "mesh edges that begin in the cell", made<leaving, 35>},
      {"points_at_cell", "mesh edges outside of the cell whose lines touch it", made<pointing, 36>},
      {"cell_contacts", "triangles with each corner on, in line with, in plane with the cell, or anywhere",
       made<anywhere, 37>}};
  return all;
}

GeneratedScene grooves_on_cells(std::uint64_t seed, std::uint64_t index) {
  return Grooves(seed, index, Grooves::Ends::mostly_open).make();
}
GeneratedScene grooves_with_lids(std::uint64_t seed, std::uint64_t index) {
  return Grooves(seed, index, Grooves::Ends::with_lids).make();
}

}  // namespace clues::fuzz
