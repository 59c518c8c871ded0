// views_of_cell: one direction in each part that incident pieces cut the cone from x to V into. Judged by sampling: directions between which no arc passes are in one part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>

#include "exact/cell/convex_cell.h"
#include "fastpath/visibility/points/integers.h"
#include "fastpath/visibility/wedges/apex.h"
#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random.h"

namespace clues::test {
namespace {

using fastpath::Apex;
using fastpath::cross;
using fastpath::dot;
using fastpath::Exact3;
using fastpath::ExactPoint;
using fastpath::LocalScene;
using fastpath::Pool;
using fastpath::Rational;

Exact3 direction(const ExactPoint& x, const ExactPoint& p) { return p.exact() - x.exact(); }

struct Arc {
  Exact3 a, b, normal;
};

std::vector<Arc> arcs_at(const LocalScene& scene, std::uint32_t v) {
  std::vector<Arc> arcs;
  for (const std::uint32_t t : scene.point_pieces[v]) {
    const auto& c = scene.pieces[t].corners;
    const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
    const Exact3 a = direction(scene.points[v], scene.points[c[(at + 1) % 3]]),
                 b = direction(scene.points[v], scene.points[c[(at + 2) % 3]]);
    arcs.push_back({a, b, cross(a, b)});
  }
  return arcs;
}

bool is_on(const Arc& arc, const Exact3& d) {
  return dot(arc.normal, cross(arc.a, d)) >= 0 && dot(arc.normal, cross(d, arc.b)) >= 0;
}

// Whether the shorter way from p to q on the sphere meets no arc; false where it is not in general position.
bool free_between(const std::vector<Arc>& arcs, const Exact3& p, const Exact3& q) {
  return std::none_of(arcs.begin(), arcs.end(), [&](const Arc& arc) {
    const Rational at_p = dot(arc.normal, p), at_q = dot(arc.normal, q);
    if (sgn(at_p) == 0 || sgn(at_q) == 0) return true;
    if (sgn(at_p) == sgn(at_q)) return false;
    return is_on(arc, Rational(abs(at_q)) * p + Rational(abs(at_p)) * q);
  });
}

struct Judged {
  std::size_t vertices = 0, views = 0, parts = 0;  // where V is seen in several parts
};

// A corner of V upon a mesh vertex: there is no distance to speak of, and the point was made with two thousand million digits.
TEST(PointTowards, HasShortCoordinatesWhateverTheDistance) {
  const ExactPoint x(Exact3{Rational(1), Rational(2), Rational(3)});
  const fastpath::Vec3<fastpath::Integer> d{fastpath::Integer(1), fastpath::Integer(0), fastpath::Integer(0)};
  for (const double distance : {0.0, 1.0, std::numeric_limits<double>::infinity()}) {
    const Exact3 off = fastpath::point_towards(x, d, distance).exact() - x.exact();
    EXPECT_GT(off.x, 0);
    EXPECT_EQ(off.y, 0);
    EXPECT_LT(mpz_sizeinbase(off.x.get_num_mpz_t(), 2) + mpz_sizeinbase(off.x.get_den_mpz_t(), 2), 2000U);
  }
}

// Every part of the sampled directions must hold a view.
void judge(const fuzz::Case& c, std::size_t samples, Judged& judged) {
  const fastpath::RoundedUp rounded_up;
  const LocalScene scene(c.mesh, exact::ConvexCell::from_doubles(c.cell));
  fuzz::Random random(c.seed * 977 + c.index);
  for (std::uint32_t v = 0; v < scene.points.size(); ++v) {
    if (scene.point_pieces[v].empty()) continue;
    Pool pool;
    const ExactPoint& x = scene.points[v];
    const Apex apex(scene, pool, false, v, &x);
    if (apex.sectors().empty() || apex.sees_cell_in_one_part()) continue;
    const std::vector<Arc> arcs = arcs_at(scene, v);
    const auto point_in_cell = [&](int spread) {
      std::vector<double> weights(scene.cell.vertices.size());
      for (double& w : weights) w = std::ldexp(random.between(1, 64), -5 * random.between(0, spread));
      return scene.cell.combination({weights.begin(), weights.end()});
    };
    const auto view_points = apex.views_of_cell(point_in_cell(0));
    std::vector<Exact3> directions;
    for (const ExactPoint& p : view_points) directions.push_back(direction(x, p));
    const std::size_t views = directions.size();
    for (std::size_t i = 0; i < samples; ++i) directions.push_back(direction(x, point_in_cell(2)));
    // Close around the ends of arcs, too, where parts may be narrow.
    const auto sees_cell = [&](const Exact3& d) {
      return std::all_of(apex.sectors().begin(), apex.sectors().end(),
                         [&](const auto& sector) { return dot(sector.plane->normal_exact(), d) < 0; });
    };
    for (const Arc& arc : arcs) {
      for (const Exact3& end : {arc.a, arc.b}) {
        for (unsigned i = 0; i < 24; ++i) {
          const Rational step = Rational(1, 1U << (4 + i % 12)) * Rational(abs(end.x) + abs(end.y) + abs(end.z));
          const auto off = [&] { return Rational(step * random.between(-9, 9)); };
          const Exact3 d = end + Exact3{off(), off(), off()};
          if (sees_cell(d)) directions.push_back(d);
        }
      }
    }
    std::vector<std::size_t> part(directions.size());
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t i = 0; i < directions.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (part[i] != part[j] && free_between(arcs, directions[i], directions[j]))
          std::replace(part.begin(), part.end(), std::max(part[i], part[j]), std::min(part[i], part[j]));
      }
    }
    for (std::size_t i = views; i < directions.size(); ++i) {
      const bool on_an_arc =
          std::any_of(arcs.begin(), arcs.end(), [&](const Arc& a) { return sgn(dot(a.normal, directions[i])) == 0; });
      EXPECT_TRUE(on_an_arc || part[i] < views) << c.generator << " " << c.index << ", vertex " << v;
    }
    std::vector<std::size_t> parts(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(views));
    std::sort(parts.begin(), parts.end());
    ++judged.vertices;
    judged.views += views;
    judged.parts += static_cast<std::size_t>(std::unique(parts.begin(), parts.end()) - parts.begin());
  }
}

TEST(ApexViews, AreInEveryPartOfWhatIsSeenOfTheCell) {
  const fuzz::GivenScenes none;
  Judged judged;
  for (const auto& generator : fuzz::generators_named({}, none)) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      const fuzz::Case c = generator.make(20261121, i);
      if (c.mesh.triangles.size() <= 40) judge(c, 80, judged);
    }
  }
  std::cout << judged.vertices << " vertices that see the cell in several parts: " << judged.views << " views in "
            << judged.parts << " parts\n";
  EXPECT_GT(judged.vertices, 100U);
  EXPECT_GT(judged.parts, judged.vertices);
}

}  // namespace
}  // namespace clues::test
