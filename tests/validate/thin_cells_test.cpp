// D3, D5, D6, D18 for cells without an interior: the checkers against a second, plain way (thin_cells.h), on
// random points amid coincidences. Each comparison is made with planted defects too, and has to notice them.
#include "tests/validate/thin_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <utility>

#include "exact/point_occlusion.h"
#include "exact/witness.h"
#include "fuzz/generators/random.h"
#include "validate/umbra_certificate.h"
#include "validate/visible_set.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;
using fuzz::Random;
using thin::Triangle;

constexpr int kPoints = 10000;  // of each dimension

std::uint64_t seed() {
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

// A cell and a few triangles, with whole and halved coordinates. Many corners lie on the cell, its rim, its
// line or plane, on other triangles, or between.
struct Scene {
  thin::Cell cell;
  std::vector<Triangle> soup;

  Scene(thin::Cell of, std::vector<Triangle> triangles) : cell(std::move(of)), soup(std::move(triangles)) {}
  Scene(Random& random, int dimension, int most) {
    do {
      cell.corners = {grid(random)};
      if (dimension > 0) cell.corners.push_back(grid(random));
      if (dimension > 1) cell.corners.push_back(grid(random));
      if (dimension > 0 && random.one_in(2)) {  // upright to axes
        for (RVector& x : cell.corners) x[2] = 0;
        if (dimension == 1) cell.corners[0][1] = cell.corners[1][1];
      }
    } while ((dimension == 1 && cell.corners[0] == cell.corners[1]) ||
             (dimension == 2 && is_zero(thin::normal_of({cell.corners[0], cell.corners[1], cell.corners[2]}))));
    if (dimension == 2 && random.one_in(2))
      cell.corners.push_back(sum(cell.corners[0], minus(cell.corners[2], cell.corners[1])));
    for (int n = random.between(1, most); n > 0; --n) {
      Triangle t;
      do {
        for (RVector& x : t) x = special(random);
      } while (is_zero(thin::normal_of(t)));
      soup.push_back(t);
    }
  }

  static RVector grid(Random& random) {
    RVector x;
    const bool halved = random.one_in(4);
    for (Rational& c : x) c = halved ? half(random.between(-6, 6)) : Rational(random.between(-3, 3));
    return x;
  }

  // Of the cell's point, line or plane; often of the cell itself.
  RVector on_cell(Random& random) const {
    RVector x = cell.corners[0];
    const bool within = random.one_in(2);
    for (std::size_t i = 1; i < 3 && i < cell.corners.size(); ++i) {
      const Rational share = within ? half(random.between(0, 4)) / 2 : half(random.between(-3, 5));
      x = sum(x, times(minus(cell.corners[i], cell.corners[0]), share));
    }
    return x;
  }

  RVector special(Random& random) const {
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

  const Triangle& any(Random& random) const {
    return soup[static_cast<std::size_t>(random.between(0, static_cast<int>(soup.size()) - 1))];
  }

  // Inside the triangle, or on its rim.
  static RVector on(const Triangle& t, Random& random, bool inside) {
    int b = random.between(inside ? 1 : 0, 3), c = random.between(inside ? 1 : 0, 4);
    RVector x = times(t[0], Rational(8 - b - c));
    x = sum(x, sum(times(t[1], Rational(b)), times(t[2], Rational(c))));
    return times(x, Rational(1, 8));
  }

  RVector in_cell(Random& random) const {
    const std::size_t n = cell.corners.size();
    RVector x = cell.corners[0];
    if (n > 1) x = mean(x, cell.corners[1]);
    if (n > 2) x = mean(x, cell.corners[2]);
    for (int k = random.between(0, 3); k > 0; --k)
      x = mean(x, cell.corners[static_cast<std::size_t>(random.between(0, static_cast<int>(n) - 1))]);
    return x;
  }

  ConvexCell exact_cell() const {
    std::vector<Point3> points;
    for (const RVector& x : cell.corners) points.push_back(to_point(x));
    return ConvexCell(points);
  }
  std::vector<exact::TriangleCorners> exact_soup() const {
    std::vector<exact::TriangleCorners> all;
    for (const Triangle& t : soup) all.push_back(exact_of(t));
    return all;
  }
  scene::TriangleMesh mesh() const {
    scene::TriangleMesh mesh;
    for (const Triangle& t : soup) {
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      for (const RVector& x : t) mesh.points.push_back({x[0].get_d(), x[1].get_d(), x[2].get_d()});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.face_of.push_back(first / 3);
    }
    return mesh;
  }
  std::string words() const {
    std::string out = "cell";
    for (const RVector& x : cell.corners) out += " (" + text(x) + ")";
    for (const Triangle& t : soup) out += "\n  triangle (" + text(t[0]) + ") (" + text(t[1]) + ") (" + text(t[2]) + ")";
    return out;
  }
};

// --- the point-occlusion oracle
// ------------------------------------------------------------------------------------------------------

struct Asked {
  const Scene& scene;
  const ConvexCell& cell;  // the same
  RVector p;
  std::optional<RVector> side;
};
struct Told {
  bool occluded = false;
  std::optional<RVector> v;
};
using Oracle = std::function<Told(const Asked&)>;

Told ask_oracle(const Asked& asked) {
  std::optional<Plane3> side;
  if (asked.side) {
    const Point3 n = to_point(*asked.side);
    side = Plane3(to_point(asked.p), n - CGAL::ORIGIN);
  }
  const auto answer = exact::point_occlusion(to_point(asked.p), side, asked.cell, asked.scene.exact_soup());
  return {answer.occluded, answer.witness ? std::optional<RVector>(read(*answer.witness)) : std::nullopt};
}

// What is wrong about an answer; empty: nothing.
std::string flaw_of(const Asked& asked, const Told& told) {
  const Scene& scene = asked.scene;
  if (thin::contains(scene.cell, asked.p)) return told.occluded ? "a point of the cell is called occluded" : "";
  if (told.occluded != thin::is_occluded(scene.cell, scene.soup, asked.p, asked.side))
    return told.occluded ? "is seen, and called occluded" : "is occluded, and called seen";
  if (told.occluded) return "";
  if (!told.v || !thin::interior_contains(scene.cell, *told.v)) return "seen from no point of int V";
  if (asked.side && sgn(dot(*asked.side, minus(*told.v, asked.p))) <= 0) return "seen from the wrong side";
  for (const Triangle& t : scene.soup) {
    if (thin::blocks(t, *told.v, asked.p)) return "the sight line is not free";
  }
  return thin::is_shaded(scene.cell, scene.soup, asked.p, *told.v) ? "not all points beside v see p" : "";
}

struct Compared {
  int points = 0, seen = 0, occluded = 0, in_cell = 0, along_cell = 0, wrong = 0;
};

// Two triangles stand on the cell and leave a line, or a point, between them that sees p = (1/2, 0, 1).
Scene scene_between(int dimension) {
  const Rational q(1, 8);
  if (dimension == 1)
    return {{{{0, 0, 0}, {1, 0, 0}}},
            {{RVector{q, -1, half(1)}, RVector{q, 1, half(1)}, RVector{Rational(5, 4), 0, -1}},
             {RVector{1 - q, -1, half(1)}, RVector{1 - q, 1, half(1)}, RVector{Rational(-1, 4), 0, -1}}}};
  return {{{{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}}},
          {{RVector{-1, 0, 0}, RVector{3, 0, 0}, RVector{1, -40, half(1)}},
           {RVector{-1, 0, 0}, RVector{3, 0, 0}, RVector{1, 40, half(1)}}}};
}

// Stops when so many answers are wrong.
Compared compare(int dimension, std::uint64_t seed, const Oracle& oracle, bool complain, int enough = 4) {
  Random random(seed + static_cast<std::uint64_t>(dimension));
  Compared total;
  if (dimension > 0) {
    const Scene scene = scene_between(dimension);
    const Asked asked{scene, scene.exact_cell(), {half(1), 0, 1}, std::nullopt};
    const std::string flaw = flaw_of(asked, oracle(asked));
    total.wrong += flaw.empty() ? 0 : 1;
    if (complain && !flaw.empty()) ADD_FAILURE() << flaw << "\n" << scene.words();
  }
  while (total.points < kPoints) {
    const Scene scene(random, dimension, 5);
    const ConvexCell cell = scene.exact_cell();
    for (int k = 0; k < 5; ++k) {
      Asked asked{scene, cell, {}, std::nullopt};
      switch (random.between(0, 3)) {
        case 0:
          asked.p = scene.on_cell(random);
          break;
        case 1: {
          const Triangle& t = scene.any(random);
          asked.p = Scene::on(t, random, false);
          if (random.one_in(2)) asked.side = thin::normal_of(t);
          break;
        }
        default:
          asked.p = Scene::grid(random);
          break;
      }
      if (!asked.side && random.one_in(4)) {
        const RVector n = Scene::grid(random);
        if (!is_zero(n)) asked.side = n;
      }
      const Told told = oracle(asked);
      const std::string flaw = flaw_of(asked, told);
      ++total.points;
      const bool inside = thin::contains(scene.cell, asked.p);
      total.in_cell += inside ? 1 : 0;
      if (!inside) (told.occluded ? total.occluded : total.seen)++;
      const auto& c = scene.cell.corners;
      const bool along = dimension == 1   ? is_zero(cross(minus(c[1], c[0]), minus(asked.p, c[0])))
                         : dimension == 2 ? sgn(dot(thin::normal_of({c[0], c[1], c[2]}), minus(asked.p, c[0]))) == 0
                                          : false;
      total.along_cell += along && !inside ? 1 : 0;
      if (flaw.empty()) continue;
      ++total.wrong;
      if (complain)
        ADD_FAILURE() << flaw << ": p " << text(asked.p) << (asked.side ? " side " + text(*asked.side) : "") << "\n"
                      << scene.words();
      if (total.wrong >= enough) return total;
    }
  }
  return total;
}

TEST(ThinCells, TheOracleAgreesWithThePlainWay) {
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) {
    const Compared c = compare(dimension, s, ask_oracle, true);
    std::cout << "dimension " << dimension << ": " << c.points << " points, " << c.seen << " seen, " << c.occluded
              << " occluded, " << c.in_cell << " in the cell, " << c.along_cell << " in its line or plane\n";
    EXPECT_GT(c.seen, 1000);
    EXPECT_GT(c.occluded, 1000);
    EXPECT_GT(c.in_cell, 100);
    EXPECT_TRUE(dimension == 0 || c.along_cell > 300);
  }
}

// As it was once: no event where a triangle crosses the line of the segment.
Told without_the_event(const Asked& asked) {
  const Scene& scene = asked.scene;
  const auto& c = scene.cell.corners;
  if (asked.side || is_zero(cross(minus(c[1], c[0]), minus(asked.p, c[0])))) return ask_oracle(asked);
  std::vector<Rational> events{0, 1};
  for (const Triangle& t : scene.soup) {
    for (const thin::Place& x : thin::section(scene.cell, t, asked.p)) {
      if (sgn(x.r) > 0 && sgn(x.u) > 0 && x.u < x.r) events.push_back(x.u / x.r);
    }
  }
  std::sort(events.begin(), events.end());
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const Rational s = (events[i] + events[i + 1]) / 2;
    const RVector v = sum(c[0], times(minus(c[1], c[0]), s));
    if (std::none_of(scene.soup.begin(), scene.soup.end(),
                     [&](const Triangle& t) { return thin::blocks(t, v, asked.p); }))
      return {false, v};
  }
  return {true, std::nullopt};
}

// As it was once: what holds a point of int V blocks nothing.
Told without_what_meets_the_cell(const Asked& asked) {
  Scene fewer = asked.scene;
  std::erase_if(fewer.soup, [&](const Triangle& t) { return thin::meets(fewer.cell, t); });
  return ask_oracle({fewer, asked.cell, asked.p, asked.side});
}

// As it was once: a single free point of int V is enough.
Told with_single_points(const Asked& asked) {
  Told told = ask_oracle(asked);
  for (const Triangle& t : asked.scene.soup) {
    for (int k = 0; k < 24; ++k) {  // along its edges
      const RVector &a = t[static_cast<std::size_t>(k) % 3], &b = t[static_cast<std::size_t>(k + 1) % 3];
      const RVector v = sum(a, times(minus(b, a), Rational(Rational(k / 3) / 8)));
      if (!told.occluded || !thin::interior_contains(asked.scene.cell, v)) continue;
      if (asked.side && sgn(dot(*asked.side, minus(v, asked.p))) <= 0) continue;
      const auto& soup = asked.scene.soup;
      if (std::none_of(soup.begin(), soup.end(), [&](const Triangle& x) { return thin::blocks(x, v, asked.p); }))
        told = {false, v};
    }
  }
  return told;
}

TEST(ThinCells, PlantedDefectsOfTheOracleAreCaught) {
  const std::uint64_t s = seed();
  EXPECT_EQ(compare(1, s, without_the_event, false).wrong, 4);
  for (const int dimension : {0, 1, 2})
    EXPECT_EQ(compare(dimension, s, without_what_meets_the_cell, false).wrong, 4) << dimension;
  for (const int dimension : {1, 2})
    EXPECT_GT(compare(dimension, s, with_single_points, false, 1).wrong, 0) << dimension;
}

// --- witnesses
// --------------------------------------------------------------------------------------------------------------------------

struct Line {
  const Scene& scene;
  std::uint32_t target;
  bool front;
  RVector v, p;
};

// Free, p inside the target, v in int V and on the right side (D5).
bool is_sight_line(const Line& line) {
  const Triangle& t = line.scene.soup[line.target];
  const RVector n = thin::normal_of(t);
  for (std::size_t i = 0; i < 3; ++i) {
    if (sgn(dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(line.p, t[i]))) <= 0) return false;
  }
  if (sgn(dot(n, minus(line.p, t[0]))) != 0 || !thin::interior_contains(line.scene.cell, line.v)) return false;
  if (sgn(dot(n, minus(line.v, t[0]))) != (line.front ? 1 : -1)) return false;
  return std::none_of(line.scene.soup.begin(), line.scene.soup.end(),
                      [&](const Triangle& x) { return thin::blocks(x, line.v, line.p); });
}

// Moves of both ends by 2^-100, within the cell and the target: far less than lies between anything in these
// scenes.
bool neighbours_are_free(const Line& line, Random& random) {
  const Rational little(Integer(1), Integer(1) << 100);
  const auto moved = [&](RVector x, const std::vector<RVector>& corners) {
    for (std::size_t i = 1; i < 3 && i < corners.size(); ++i)
      x = sum(x, times(minus(corners[i], corners[0]), Rational(little * random.between(-9, 9))));
    return x;
  };
  const Triangle& t = line.scene.soup[line.target];
  for (int k = 0; k < 6; ++k) {
    const RVector v = moved(line.v, line.scene.cell.corners), p = moved(line.p, {t[0], t[1], t[2]});
    for (const Triangle& x : line.scene.soup) {
      if (thin::blocks(x, v, p)) return false;
    }
  }
  return true;
}

struct Checked {
  int lines = 0, valid = 0, special = 0, wrong = 0;
};

// `lenient` plants the defect that a free line is believed wherever its ends are.
Checked check_witnesses(int dimension, std::uint64_t seed, bool lenient) {
  Random random(seed + 10 + static_cast<std::uint64_t>(dimension));
  Checked total;
  while (total.lines < kPoints) {
    const Scene scene(random, dimension, 4);
    const scene::TriangleMesh mesh = scene.mesh();
    const ConvexCell cell = scene.exact_cell();
    for (int k = 0; k < 5; ++k, ++total.lines) {
      const auto target = static_cast<std::uint32_t>(random.between(0, static_cast<int>(scene.soup.size()) - 1));
      const Triangle& t = scene.soup[target];
      Line line{scene, target, true, scene.in_cell(random), Scene::on(t, random, !random.one_in(8))};
      if (random.one_in(4)) line.v = scene.special(random);
      if (random.one_in(4)) line.p = scene.any(random)[0];
      line.front = sgn(dot(thin::normal_of(t), minus(line.v, t[0]))) > 0;
      if (random.one_in(8)) line.front = !line.front;
      auto verdict = exact::check_witness(mesh, cell, target, line.front, to_point(line.v), to_point(line.p));
      if (lenient && verdict.special) verdict.valid = true;
      total.valid += verdict.valid ? 1 : 0;
      total.special += verdict.special ? 1 : 0;
      const bool free = is_sight_line(line);
      bool held = false, touched = false;
      for (const Triangle& x : scene.soup) {
        held = held || (dimension > 0 && thin::holds(x, line.v));
        const bool flat = is_zero(cross(thin::normal_of(x), thin::normal_of(t)));
        touched = touched || (!flat && thin::holds(x, line.p));
      }
      bool right = !verdict.valid || (free && neighbours_are_free(line, random) &&
                                      !thin::is_shaded(scene.cell, scene.soup, line.p, line.v));
      right = right && (verdict.valid || !free || (verdict.special && (held || touched)));
      right = right && (lenient || !verdict.special || free);
      if (right) continue;
      ++total.wrong;
      if (!lenient)
        ADD_FAILURE() << (verdict.valid ? "accepted" : verdict.reason) << ": v " << text(line.v) << " p "
                      << text(line.p) << " on triangle " << target << "\n"
                      << scene.words();
      if (total.wrong > 3) return total;
    }
  }
  return total;
}

TEST(ThinCells, WitnessesAgreeWithThePlainWay) {
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) {
    const Checked c = check_witnesses(dimension, s, false);
    std::cout << "dimension " << dimension << ": " << c.lines << " sight lines, " << c.valid << " accepted, "
              << c.special << " free, but touched at an end\n";
    EXPECT_GT(c.valid, 1000);
    EXPECT_GT(c.special, 10);
  }
}

TEST(ThinCells, AWitnessCheckerThatBelievesTouchedEndsIsCaught) {
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) EXPECT_EQ(check_witnesses(dimension, s, true).wrong, 4) << dimension;
}

// --- hidden triangles
// --------------------------------------------------------------------------------------------------------------------

// Behind a plate, within the pyramid over it from a point q, nothing is seen from what lies in the pyramid
// before the plate.
struct Frustum {
  RVector q;
  Triangle plate;
  thin::Cell cell;
  UmbraCertificate facets;

  Frustum(Random& random, int dimension) {
    do {
      q = Scene::grid(random);
      for (RVector& x : plate) x = Scene::grid(random);
    } while (is_zero(thin::normal_of(plate)) || sgn(dot(thin::normal_of(plate), minus(q, plate[0]))) == 0);
    do {
      cell.corners.clear();
      for (int i = 0; i <= dimension; ++i) cell.corners.push_back(at(random, Rational(random.between(0, 7), 8), false));
    } while ((dimension == 1 && cell.corners[0] == cell.corners[1]) ||
             (dimension == 2 && is_zero(thin::normal_of({cell.corners[0], cell.corners[1], cell.corners[2]}))));
    Triangle far;
    for (std::size_t i = 0; i < 3; ++i) far[i] = sum(q, times(minus(plate[i], q), Rational(3)));
    RVector middle{};
    for (std::size_t i = 0; i < 3; ++i) middle = sum(middle, times(sum(plate[i], far[i]), Rational(1, 6)));
    const auto add = [&](std::optional<std::uint32_t> triangle, Triangle t) {
      if (sgn(dot(thin::normal_of(t), minus(middle, t[0]))) > 0) std::swap(t[1], t[2]);
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

  // In the pyramid, `share` of the way from q to the plate.
  RVector at(Random& random, Rational share, bool inside) const {
    share.canonicalize();
    return sum(q, times(minus(Scene::on(plate, random, inside), q), share));
  }

  // Behind the plate, in the frustum; or, if it is to be wild, in part anywhere.
  Triangle triangle(Random& random, const Scene& scene, bool wild) const {
    Triangle t;
    do {
      for (RVector& x : t) {
        x = at(random, Rational(wild ? random.between(4, 28) : random.between(9, 23), 8), !wild);
        if (wild && random.one_in(3)) x = random.one_in(2) ? scene.on_cell(random) : Scene::grid(random);
      }
    } while (is_zero(thin::normal_of(t)));
    return t;
  }
};

using HiddenProof = std::function<bool(const scene::TriangleMesh&, const ConvexCell&, const UmbraCertificate&, bool)>;

struct Proved {
  int triangles = 0, hidden = 0, meet_cell = 0, wrong = 0;
};

Proved compare_proofs(int dimension, std::uint64_t seed, const HiddenProof& proves, bool complain) {
  Random random(seed + 20 + static_cast<std::uint64_t>(dimension));
  Proved total;
  while (total.triangles < kPoints) {
    const Frustum frustum(random, dimension);
    Scene scene(random, dimension, 1);
    scene.cell = frustum.cell;
    const ConvexCell cell = scene.exact_cell();
    for (int k = 0; k < 5; ++k) {
      const bool strictly_inside = random.one_in(2);
      const Triangle t = frustum.triangle(random, scene, !strictly_inside);
      scene.soup = {frustum.plate, t};
      const scene::TriangleMesh mesh = scene.mesh();
      if (k == 0) {
        const auto verdict = check_umbra_certificate(mesh, cell, frustum.facets);
        if (!verdict.valid) ADD_FAILURE() << verdict.reason << "\n" << scene.words();
      }
      const bool meets = thin::meets(frustum.cell, t);
      total.meet_cell += meets ? 1 : 0;
      for (const bool front : {true, false}) {
        ++total.triangles;
        const bool hidden = proves(mesh, cell, frustum.facets, front);
        total.hidden += hidden ? 1 : 0;
        const RVector n = front ? thin::normal_of(t) : times(thin::normal_of(t), Rational(-1));
        bool right = !hidden || !meets;
        for (int i = 0; i < 3 && right && hidden; ++i)
          right = thin::is_occluded(frustum.cell, {frustum.plate}, Scene::on(t, random, true), n);
        const bool faces_away = std::none_of(frustum.cell.corners.begin(), frustum.cell.corners.end(),
                                             [&](const RVector& x) { return sgn(dot(n, minus(x, t[0]))) > 0; });
        right = right && (hidden || meets || !(faces_away || strictly_inside));
        if (right) continue;
        ++total.wrong;
        if (complain) ADD_FAILURE() << (hidden ? "proved hidden" : "not proved hidden") << "\n" << scene.words();
        if (total.wrong > 3) return total;
      }
    }
  }
  return total;
}

bool ask_proof(const scene::TriangleMesh& mesh, const ConvexCell& cell, const UmbraCertificate& facets, bool front) {
  return proves_hidden(mesh, cell, facets, 1, front);
}

TEST(ThinCells, ProofsThatTrianglesAreHiddenAgreeWithThePlainWay) {
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) {
    const Proved p = compare_proofs(dimension, s, ask_proof, true);
    std::cout << "dimension " << dimension << ": " << p.triangles << " sides of triangles, " << p.hidden << " hidden; "
              << p.meet_cell << " triangles meet the cell\n";
    EXPECT_GT(p.hidden, 1000);
    EXPECT_GT(p.meet_cell, 100);
  }
}

// As it was once: a side that nothing of the cell is before is hidden, and nobody asks whether the triangle
// touches the cell.
TEST(ThinCells, AProofThatDoesNotAskForTheCellIsCaught) {
  const auto faces_away = [](const scene::TriangleMesh& mesh, const ConvexCell& cell, const UmbraCertificate& facets,
                             bool front) {
    const auto corner = [&](std::size_t i) { return exact::to_exact(mesh.points[mesh.triangles[1][i]]); };
    const Plane3 plane(corner(0), corner(1), corner(2));
    const auto before = front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    return ask_proof(mesh, cell, facets, front) ||
           std::none_of(cell.vertices().begin(), cell.vertices().end(),
                        [&](const Point3& x) { return plane.oriented_side(x) == before; });
  };
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) EXPECT_EQ(compare_proofs(dimension, s, faces_away, false).wrong, 4);
}

// --- the exact visible set
// ----------------------------------------------------------------------------------------------------------------

// Hidden: no point of a triangle that no other touches is seen. Visible: the witness is one. From a point,
// the triangle itself is the polygon to be covered.
TEST(ThinCells, VisibleSetsAgreeWithThePlainWay) {
  const std::uint64_t s = seed();
  for (const int dimension : {0, 1, 2}) {
    Random random(s + 30 + static_cast<std::uint64_t>(dimension));
    int visible = 0, hidden = 0, points = 0;
    for (int round = 0; round < 300; ++round) {
      Scene scene(random, dimension, 6);
      if (round % 3 != 0) {  // most of it behind a plate
        const Frustum frustum(random, dimension);
        scene.cell = frustum.cell;
        scene.soup = {frustum.plate};
        for (int k = random.between(1, 4); k > 0; --k)
          scene.soup.push_back(frustum.triangle(random, scene, random.one_in(3)));
      }
      VisibleSetOptions options;
      options.trust_map = false;
      options.points_first = round % 2 == 0;
      const VisibleSet set = exact_visible_set(scene.mesh(), scene.exact_cell(), options);
      for (std::uint32_t i = 0; i < scene.soup.size(); ++i) {
        const Triangle& t = scene.soup[i];
        const TriangleSight& told = set.triangles[i];
        ASSERT_EQ(told.meets_cell, thin::meets(scene.cell, t)) << i << "\n" << scene.words();
        if (told.meets_cell) continue;
        (told.sight == Sight::visible ? visible : hidden)++;
        if (told.sight == Sight::visible) {
          ASSERT_TRUE(told.witness.has_value());
          const Line line{scene, i, told.witness->front, read(told.witness->v), read(told.witness->p)};
          ASSERT_TRUE(is_sight_line(line) && !thin::is_shaded(scene.cell, scene.soup, line.p, line.v));
          continue;
        }
        ASSERT_EQ(told.sight, Sight::hidden);
        std::vector<Triangle> others = scene.soup;
        others.erase(others.begin() + i);
        if (dimension == 0) {
          const RVector& v = scene.cell.corners[0];
          const bool beside = sgn(dot(thin::normal_of(t), minus(v, t[0]))) != 0;
          ASSERT_TRUE(!beside || thin::is_occluded({{t[0], t[1], t[2]}}, others, v, std::nullopt)) << scene.words();
        }
        for (int k = 0; k < 12; ++k) {
          const RVector p = Scene::on(t, random, true);
          if (std::any_of(others.begin(), others.end(), [&](const Triangle& x) { return thin::holds(x, p); })) continue;
          ++points;
          for (const int sign : {1, -1}) {
            ASSERT_TRUE(thin::is_occluded(scene.cell, others, p, times(thin::normal_of(t), Rational(sign))))
                << "triangle " << i << " is seen at " << text(p) << "\n"
                << scene.words();
          }
        }
      }
    }
    std::cout << "dimension " << dimension << ": " << visible << " visible, " << hidden << " hidden triangles, "
              << points << " points of these\n";
    EXPECT_GT(visible, 100);
    EXPECT_GT(hidden, 30);
    EXPECT_GT(points, 300);
  }
}

}  // namespace
}  // namespace clues::validate
