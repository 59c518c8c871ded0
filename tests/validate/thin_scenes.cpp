#include "tests/validate/thin_scenes.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <utility>

namespace clues::validate::thin {

using exact::Point3;

std::uint64_t seed_of_run() {
  const char* text = std::getenv("CLUES_SEED");
  const std::uint64_t seed = text ? std::strtoull(text, nullptr, 10) : 20261122;
  std::cout << "seed " << seed << " (CLUES_SEED)\n";
  return seed;
}
Rational half(int n) {
  Rational x(n, 2);
  x.canonicalize();
  return x;
}

RVector mean(const RVector& a, const RVector& b) { return times(sum(a, b), half(1)); }

exact::TriangleCorners exact_of(const Triangle& t) { return {to_point(t[0]), to_point(t[1]), to_point(t[2])}; }

std::string text(const RVector& x) { return x[0].get_str() + " " + x[1].get_str() + " " + x[2].get_str(); }

Scene::Scene(Random& random, int dimension, int most) {
  do {
    cell.corners = {grid(random)};
    if (dimension > 0) cell.corners.push_back(grid(random));
    if (dimension > 1) cell.corners.push_back(grid(random));
    if (dimension > 0 && random.one_in(2)) {  // upright to axes
      for (RVector& x : cell.corners) x[2] = 0;
      if (dimension == 1) cell.corners[0][1] = cell.corners[1][1];
    }
  } while ((dimension == 1 && cell.corners[0] == cell.corners[1]) ||
           (dimension == 2 && is_zero(normal_of({cell.corners[0], cell.corners[1], cell.corners[2]}))));
  if (dimension == 2 && random.one_in(2))
    cell.corners.push_back(sum(cell.corners[0], minus(cell.corners[2], cell.corners[1])));
  for (int n = random.between(1, most); n > 0; --n) {
    Triangle t;
    do {
      for (RVector& x : t) x = special(random);
    } while (is_zero(normal_of(t)));
    soup.push_back(t);
  }
}

RVector Scene::grid(Random& random) {
  RVector x;
  const bool halved = random.one_in(4);
  for (Rational& c : x) c = halved ? half(random.between(-6, 6)) : Rational(random.between(-3, 3));
  return x;
}

RVector Scene::on_cell(Random& random) const {
  RVector x = cell.corners[0];
  const bool within = random.one_in(2);
  for (std::size_t i = 1; i < 3 && i < cell.corners.size(); ++i) {
    const Rational share = within ? half(random.between(0, 4)) / 2 : half(random.between(-3, 5));
    x = sum(x, times(minus(cell.corners[i], cell.corners[0]), share));
  }
  return x;
}

RVector Scene::special(Random& random) const {
  switch (random.between(0, soup.empty() ? 2 : 4)) {
    case 0:
    case 1:
      return grid(random);
    case 2:
      return on_cell(random);
    case 3: {
      const Triangle& t = any(random);
      return random.one_in(3) ? t[0] : random.one_in(2) ? mean(t[0], t[1]) : on(t, random, true);
    }
    default:
      return mean(on_cell(random), any(random)[2]);
  }
}

const Triangle& Scene::any(Random& random) const {
  return soup[static_cast<std::size_t>(random.between(0, static_cast<int>(soup.size()) - 1))];
}

RVector Scene::on(const Triangle& t, Random& random, bool inside) {
  int b = random.between(inside ? 1 : 0, 3), c = random.between(inside ? 1 : 0, 4);
  RVector x = times(t[0], Rational(8 - b - c));
  x = sum(x, sum(times(t[1], Rational(b)), times(t[2], Rational(c))));
  return times(x, Rational(1, 8));
}

RVector Scene::in_cell(Random& random) const {
  const std::size_t n = cell.corners.size();
  RVector x = cell.corners[0];
  if (n > 1) x = mean(x, cell.corners[1]);
  if (n > 2) x = mean(x, cell.corners[2]);
  for (int k = random.between(0, 3); k > 0; --k)
    x = mean(x, cell.corners[static_cast<std::size_t>(random.between(0, static_cast<int>(n) - 1))]);
  return x;
}

exact::ConvexCell Scene::exact_cell() const {
  std::vector<Point3> points;
  for (const RVector& x : cell.corners) points.push_back(to_point(x));
  return exact::ConvexCell(points);
}

std::vector<exact::TriangleCorners> Scene::exact_soup() const {
  std::vector<exact::TriangleCorners> all;
  for (const Triangle& t : soup) all.push_back(exact_of(t));
  return all;
}

scene::TriangleMesh Scene::mesh() const {
  scene::TriangleMesh mesh;
  for (const Triangle& t : soup) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const RVector& x : t) mesh.points.push_back({x[0].get_d(), x[1].get_d(), x[2].get_d()});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.face_of.push_back(first / 3);
  }
  return mesh;
}

std::string Scene::words() const {
  std::string out = "cell";
  for (const RVector& x : cell.corners) out += " (" + text(x) + ")";
  for (const Triangle& t : soup) out += "\n  triangle (" + text(t[0]) + ") (" + text(t[1]) + ") (" + text(t[2]) + ")";
  return out;
}

Frustum::Frustum(Random& random, int dimension) {
  do {
    q = Scene::grid(random);
    for (RVector& x : plate) x = Scene::grid(random);
  } while (is_zero(normal_of(plate)) || sgn(dot(normal_of(plate), minus(q, plate[0]))) == 0);
  do {
    cell.corners.clear();
    for (int i = 0; i <= dimension; ++i) cell.corners.push_back(at(random, Rational(random.between(0, 7), 8), false));
  } while ((dimension == 1 && cell.corners[0] == cell.corners[1]) ||
           (dimension == 2 && is_zero(normal_of({cell.corners[0], cell.corners[1], cell.corners[2]}))));
  Triangle far;
  for (std::size_t i = 0; i < 3; ++i) far[i] = sum(q, times(minus(plate[i], q), Rational(3)));
  RVector middle{};
  for (std::size_t i = 0; i < 3; ++i) middle = sum(middle, times(sum(plate[i], far[i]), Rational(1, 6)));
  const auto add = [&](std::optional<std::uint32_t> triangle, Triangle t) {
    if (sgn(dot(normal_of(t), minus(middle, t[0]))) > 0) std::swap(t[1], t[2]);
    facets.push_back({triangle, t});
  };
  add(0, plate);
  add(std::nullopt, far);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    add(std::nullopt, {plate[i], plate[k], far[i]});
    add(std::nullopt, {far[i], plate[k], far[k]});
  }
}

RVector Frustum::at(Random& random, Rational share, bool inside) const {
  share.canonicalize();
  return sum(q, times(minus(Scene::on(plate, random, inside), q), share));
}

Triangle Frustum::triangle(Random& random, const Scene& scene, bool wild) const {
  Triangle t;
  do {
    for (RVector& x : t) {
      x = at(random, Rational(wild ? random.between(4, 28) : random.between(9, 23), 8), !wild);
      if (wild && random.one_in(3)) x = random.one_in(2) ? scene.on_cell(random) : Scene::grid(random);
    }
  } while (is_zero(normal_of(t)));
  return t;
}

bool is_sight_line(const Line& line) {
  const Triangle& t = line.scene.soup[line.target];
  const RVector n = normal_of(t);
  for (std::size_t i = 0; i < 3; ++i) {
    if (sgn(dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(line.p, t[i]))) <= 0) return false;
  }
  if (sgn(dot(n, minus(line.p, t[0]))) != 0 || !interior_contains(line.scene.cell, line.v)) return false;
  if (sgn(dot(n, minus(line.v, t[0]))) != (line.front ? 1 : -1)) return false;
  return std::none_of(line.scene.soup.begin(), line.scene.soup.end(),
                      [&](const Triangle& x) { return blocks(x, line.v, line.p); });
}

}  // namespace clues::validate::thin
