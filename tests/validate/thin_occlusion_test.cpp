// D18 for cells without an interior: the point-occlusion oracle against the plain way (thin_cells.h), on random points
// amid coincidences; with planted defects too, which the comparison has to notice.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include "exact/sight/point_occlusion.h"
#include "tests/validate/thin_scenes.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::Plane3;
using exact::Point3;
using thin::half;
using thin::Random;
using thin::Scene;
using thin::text;
using thin::Triangle;

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
  while (total.points < thin::kPoints) {
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
  const std::uint64_t s = thin::seed_of_run();
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
  const std::uint64_t s = thin::seed_of_run();
  EXPECT_EQ(compare(1, s, without_the_event, false).wrong, 4);
  for (const int dimension : {0, 1, 2})
    EXPECT_EQ(compare(dimension, s, without_what_meets_the_cell, false).wrong, 4) << dimension;
  for (const int dimension : {1, 2})
    EXPECT_GT(compare(dimension, s, with_single_points, false, 1).wrong, 0) << dimension;
}

}  // namespace
}  // namespace clues::validate
