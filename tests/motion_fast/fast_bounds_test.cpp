// Motion bounds in doubles against exact arithmetic (D29, T8, T9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "exact/motion/compare_bounds.h"
#include "fastpath/motion/bounds/bounds.h"
#include "fastpath/motion/bounds/predicates.h"
#include "scene/messages/error.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

using namespace fastpath::motion;

struct Scene {
  std::array<DepthSample, 4> s;
  MotionPoint v{};
  std::array<Row, 4> rows() const { return {row_of(s[0], v), row_of(s[1], v), row_of(s[2], v), row_of(s[3], v)}; }
};

// Four samples within an angle, at depths that vary by `depth`; some are directions; far away from the origin for some, by powers of two apart for others.
Scene scene_of(fuzz::Random& random) {
  constexpr std::array angles{0.3, 0.1, 0.03, 0.01, 1e-3, 1e-5};
  constexpr std::array depths{0.0, 1e-9, 0.02, 0.1, 0.7};
  const double angle = angles[static_cast<std::size_t>(random.between(0, 5))];
  const double depth = depths[static_cast<std::size_t>(random.between(0, 4))];
  const double size = std::ldexp(1, random.between(-3, 3) * (random.one_in(10) ? 10 : 1));
  const bool plane = random.one_in(3), thin = random.one_in(8);
  const MotionPoint d = direction(random), n = direction(random), along = direction(random);
  Scene scene;
  if (random.one_in(4)) scene.v = {uniform(random, -100, 100), uniform(random, -100, 100), uniform(random, -100, 100)};
  for (DepthSample& s : scene.s) {
    const MotionPoint off = direction(random);
    const double slide = angle * uniform(random, -1, 1);
    MotionPoint x{};
    double across = 0, square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = d[i] + (thin ? slide * along[i] + 1e-3 * angle * off[i] : angle * off[i]);
      across += x[i] * n[i];
      square += x[i] * x[i];
    }
    double r = size * (1 + depth * uniform(random, -1, 1)) / std::sqrt(square);
    if (plane && std::fabs(across) > 0.2) r = size / std::fabs(across);
    s.is_direction = random.one_in(12);
    for (std::size_t i = 0; i < 3; ++i) s.at[i] = s.is_direction ? x[i] * size : scene.v[i] + r * x[i];
  }
  return scene;
}

void turn_to_face(Scene& scene) {
  if (exact::facing_sign(exact::sight_row(scene.s[0], scene.v), exact::sight_row(scene.s[1], scene.v),
                         exact::sight_row(scene.s[2], scene.v)) < 0) {
    std::swap(scene.s[1], scene.s[2]);
  }
}

mpq_class squared(double x) { return mpq_class(x) * mpq_class(x); }

TEST(FastBounds, FacingAndEdgesAreNeverAboveTheExactOnesAndHardlyBelow) {
  fuzz::Random random(1);
  int facing = 0, edges = 0, tight_facing = 0, tight_edges = 0;
  std::map<exact::EdgeBranch, std::array<int, 2>> branches;  // how many, and how many tight
  for (int k = 0; k < 4000; ++k) {
    Scene scene = scene_of(random);
    turn_to_face(scene);
    MotionThresholds thresholds;
    thresholds.kappa = std::array{2000.0, 20.0, 1.0, 0.0, -0.5}[static_cast<std::size_t>(random.between(0, 4))];
    const BoundThresholds limits(thresholds);
    const exact::ExactThresholds exact_limits(thresholds);
    const auto v = exact::exact_viewpoint(scene.v);
    const auto rows = scene.rows();
    const double d = facing_bound(rows[0], rows[1], rows[2]);
    if (d > 0 && std::isfinite(d)) {
      ++facing;
      ASSERT_GE(exact::compare_facing_bound(scene.s[0], scene.s[1], scene.s[2], v, squared(d)), 0) << k;
      tight_facing += exact::compare_facing_bound(scene.s[0], scene.s[1], scene.s[2], v, squared(d * (1 + 1e-6))) <= 0;
    }
    const double e = edge_bound(rows[0], rows[1], limits);
    if (e > 0 && std::isfinite(e)) {
      ++edges;
      ASSERT_GE(exact::compare_edge_bound(scene.s[0], scene.s[1], v, exact_limits, squared(e)), 0) << k;
      const bool tight =
          exact::compare_edge_bound(scene.s[0], scene.s[1], v, exact_limits, squared(e * (1 + 1e-3))) <= 0;
      tight_edges += tight;
      auto& [all, of_them] = branches[exact::edge_branch(scene.s[0], scene.s[1], v, exact_limits)];
      ++all;
      of_them += tight;
    } else if (e > 0) {
      EXPECT_TRUE(scene.s[0].is_direction && scene.s[1].is_direction);
    }
  }
  EXPECT_GT(facing, 3000);
  EXPECT_GT(edges, 700);
  EXPECT_GT(tight_facing, facing * 8 / 10);
  EXPECT_GT(tight_edges, edges * 8 / 10);
  // Each branch is taken; the others are where nothing is left of thin values.
  for (const auto branch : {exact::EdgeBranch::end_point, exact::EdgeBranch::tube, exact::EdgeBranch::cone_side}) {
    EXPECT_GT(branches[branch][0], 40) << static_cast<int>(branch);
    EXPECT_GT(branches[branch][1], branches[branch][0] * 3 / 4) << static_cast<int>(branch);
  }
}

// Where the square of kappa is no double any more, no bound is left, but none is too large.
TEST(FastBounds, OfTheGreatestCotangentsAreNotAboveTheExactOnes) {
  fuzz::Random random(3);
  int bounds = 0;
  for (int k = 0; k < 2000; ++k) {
    const Scene scene = scene_of(random);
    MotionThresholds thresholds;
    thresholds.kappa = std::array{1e16, -1e16, 1e60, 1e150, 1e200, 1e308}[static_cast<std::size_t>(k % 6)];
    const auto rows = scene.rows();
    const double e = edge_bound(rows[0], rows[1], BoundThresholds(thresholds));
    if (!(e > 0 && std::isfinite(e))) continue;
    ++bounds;
    ASSERT_GE(exact::compare_edge_bound(scene.s[0], scene.s[1], exact::exact_viewpoint(scene.v),
                                        exact::ExactThresholds(thresholds), squared(e)),
              0)
        << k;
  }
  EXPECT_GT(bounds, 700);
}

// With one that is no number every bound was 0, or that of the other constraints, and nobody was told.
TEST(FastBounds, WhatIsNoThresholdIsRefused) {
  const auto code_of = [](double kappa, double sigma) -> std::optional<scene::ErrorCode> {
    try {
      const BoundThresholds limits({kappa, sigma, false});
    } catch (const scene::Error& e) {
      return e.code();
    }
    return std::nullopt;
  };
  const double inf = kInfinity, nan = std::numeric_limits<double>::quiet_NaN();
  for (const double kappa : {inf, -inf, nan}) EXPECT_EQ(code_of(kappa, 4e-14), scene::ErrorCode::non_finite) << kappa;
  for (const double sigma : {inf, nan}) EXPECT_EQ(code_of(2000, sigma), scene::ErrorCode::non_finite) << sigma;
  for (const double sigma : {-1e-300, 1.5}) EXPECT_EQ(code_of(2000, sigma), scene::ErrorCode::bad_argument) << sigma;
  for (const double sigma : {0.0, 5e-324, 1.0}) EXPECT_EQ(code_of(2000, sigma), std::nullopt) << sigma;
  for (const double kappa : {0.0, -2.0, 1e308}) EXPECT_EQ(code_of(kappa, 4e-14), std::nullopt) << kappa;
}

// Viewpoints on the sphere just below the bound: none violates. The most adverse direction first: against the gradient.
TEST(FastBounds, NoViewpointNearerViolatesAnything) {
  fuzz::Random random(2);
  int triangles = 0, quadrangles = 0;
  for (int k = 0; k < 1500; ++k) {
    Scene scene = scene_of(random);
    turn_to_face(scene);
    MotionThresholds thresholds;
    thresholds.kappa = random.one_in(2) ? 2000 : 50;
    thresholds.sigma = random.one_in(2) ? 4e-14 : 1e-6;
    const exact::ExactThresholds limits(thresholds);
    const auto rows = scene.rows();
    const double m = triangle_bound(rows[0], rows[1], rows[2], BoundThresholds(thresholds));
    const double d = delaunay_bound(rows[0], rows[1], rows[2], rows[3]);
    triangles += m > 0 && std::isfinite(m);
    quadrangles += d > 0 && std::isfinite(d);
    for (int w = 0; w < 12; ++w) {
      const MotionPoint way = direction(random);
      const auto at = [&](double far) {
        MotionPoint p{};
        for (std::size_t i = 0; i < 3; ++i) p[i] = scene.v[i] + way[i] * std::min(far, 1e6) * (1 - 1e-12);
        return p;
      };
      const auto row = [&](std::size_t i, const MotionPoint& p) { return exact::sight_row(scene.s[i], p); };
      if (m > 0) {
        const MotionPoint p = at(m);
        const auto a = row(0, p), b = row(1, p), c = row(2, p);
        ASSERT_GT(exact::facing_sign(a, b, c), 0) << k;
        ASSERT_TRUE(exact::edge_length_holds(a, b, limits)) << k;
        ASSERT_TRUE(exact::edge_length_holds(b, c, limits)) << k;
        ASSERT_TRUE(exact::edge_length_holds(c, a, limits)) << k;
        ASSERT_TRUE(exact::separation_holds(a, b, c, limits)) << k;
        ASSERT_TRUE(exact::separation_holds(b, c, a, limits)) << k;
        ASSERT_TRUE(exact::separation_holds(c, a, b, limits)) << k;
      }
      if (d > 0) {
        const MotionPoint p = at(d);
        ASSERT_GE(exact::delaunay_sign(row(0, p), row(1, p), row(2, p), row(3, p)), 0) << k;
      }
    }
  }
  EXPECT_GT(triangles, 600);
  EXPECT_GT(quadrangles, 300);
}

// The nearest point, on the sphere of a radius around v, at which a linear search finds least of a constraint: against its gradient, time and again. `value` of a viewpoint.
template <class Value>
MotionPoint worst_on_sphere(const Scene& scene, double radius, MotionPoint way, const Value& value) {
  const auto at = [&](const MotionPoint& w, std::size_t i, double more) {
    MotionPoint p = scene.v;
    for (std::size_t k = 0; k < 3; ++k) p[k] += radius * w[k] + (k == i ? more : 0);
    return value(p);
  };
  for (int round = 0; round < 6; ++round) {
    MotionPoint slope{};
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      slope[i] = at(way, i, 1e-4 * radius) - at(way, i, -1e-4 * radius);
      square += slope[i] * slope[i];
    }
    if (!(square > 0)) return way;
    for (std::size_t i = 0; i < 3; ++i) way[i] = -slope[i] / std::sqrt(square);
  }
  return way;
}

double delaunay_of_units(const Scene& scene, const MotionPoint& p) {
  std::array<Row, 4> r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = row_of(scene.s[i], p);
  return delaunay_value(r[0], r[1], r[2], r[3]) / ((r[0].length * r[1].length) * (r[2].length * r[3].length));
}

struct Attack {
  std::uint64_t viewpoints = 0, violations = 0, exact = 0;
};

// Viewpoints just within the bound times a factor: `tries` for each, most of them crowded around the worst direction. By the filter, and exactly where it is unsure.
Attack adversarial_viewpoints(std::uint64_t wanted, int tries, std::uint64_t seed, bool delaunay, double factor = 1) {
  fuzz::Random random(seed);
  Attack attack;
  Constraints decide({2000, 1e-6, true});
  while (attack.viewpoints < wanted) {
    Scene scene = scene_of(random);
    turn_to_face(scene);
    if (scene.v != MotionPoint{}) continue;  // from the origin viewpoints are as far as they say
    const auto rows = scene.rows();
    const double bound = delaunay ? delaunay_bound(rows[0], rows[1], rows[2], rows[3])
                                  : separation_bound(rows[0], rows[1], rows[2], BoundThresholds(decide.thresholds()));
    if (!(bound > 0) || !std::isfinite(bound)) continue;
    const double radius = factor * bound * (1 - 0x1p-46);
    const auto value = [&](const MotionPoint& p) {
      if (delaunay) return delaunay_of_units(scene, p);
      std::array<Row, 3> r;
      for (std::size_t i = 0; i < 3; ++i) r[i] = row_of(scene.s[i], p);
      return determinant(r[0], r[1], r[2]) / (norm(cross(r[1].x, r[2].x)) * r[0].length);
    };
    MotionPoint worst{};
    for (int k = 0; k < tries; ++k) {
      if (k % 64 == 0) worst = worst_on_sphere(scene, radius, direction(random), value);
      MotionPoint way = direction(random), p{};
      if (k % 4 != 0) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          way[i] = worst[i] + std::ldexp(way[i], -(k % 23));
          square += way[i] * way[i];
        }
        for (double& x : way) x /= std::sqrt(square);
      }
      std::array<Row, 4> r;
      for (std::size_t i = 0; i < 3; ++i) p[i] = radius * way[i] * (1 - 0x1p-50);
      for (std::size_t i = 0; i < 4; ++i) r[i] = row_of(scene.s[i], p);
      const auto seen = [&](std::size_t i) { return Seen{&scene.s[i], &r[i]}; };
      const bool holds = delaunay ? decide.delaunay(seen(0), seen(1), seen(2), seen(3), p) >= 0
                                  : decide.separation(seen(0), seen(1), seen(2), p);
      ++attack.viewpoints;
      attack.violations += holds ? 0 : 1;
    }
  }
  attack.exact = decide.counts.exact;
  return attack;
}

void expect_no_violation(std::uint64_t viewpoints, int tries, std::uint64_t seed) {
  for (const bool delaunay : {true, false}) {
    const Attack attack = adversarial_viewpoints(viewpoints, tries, seed, delaunay);
    EXPECT_EQ(attack.violations, 0U);
    std::printf("%s: %llu viewpoints, %llu of them decided by whole numbers\n", delaunay ? "Delaunay" : "separation",
                static_cast<unsigned long long>(attack.viewpoints), static_cast<unsigned long long>(attack.exact));
  }
}

TEST(FastBounds, AMillionAdversarialViewpoints) { expect_no_violation(1'000'000, 256, 5); }
TEST(FastBoundsLong, TenMillionAdversarialViewpoints) { expect_no_violation(10'000'000, 2048, 7); }

// Triangles and edges, and viewpoints at up to twice their bounds: what violates is not nearer than the bound. Every branch of the exact bound of an edge is taken.
void compare_with_viewpoints(int scenes, int viewpoints, std::uint64_t seed) {
  fuzz::Random random(seed);
  std::map<exact::EdgeBranch, int> branches;
  std::uint64_t held = 0, violated = 0;
  int triangles = 0, edges = 0;
  while (triangles < scenes || edges < scenes) {
    Scene scene = scene_of(random);
    if (random.one_in(20)) {  // a direction on the other side
      scene.s[0].is_direction = true;
      for (double& x : scene.s[0].at) x = -x;
    }
    turn_to_face(scene);
    if (scene.v != MotionPoint{}) continue;
    MotionThresholds thresholds;
    thresholds.kappa = std::array{2000.0, 20.0, 1.0, 0.0, -0.5}[static_cast<std::size_t>(random.between(0, 4))];
    const auto &a = scene.s[0], &b = scene.s[1];
    ++branches[exact::edge_branch(a, b, exact::exact_viewpoint(scene.v), exact::ExactThresholds(thresholds))];
    Constraints decide(thresholds);
    const auto rows = scene.rows();
    const double facing = facing_bound(rows[0], rows[1], rows[2]);
    const double edge = edge_bound(rows[0], rows[1], BoundThresholds(thresholds));
    for (const bool of_edge : {false, true}) {
      const double bound = of_edge ? edge : facing;
      int& made = of_edge ? edges : triangles;
      if (bound == 0 || made == scenes) continue;
      ++made;
      for (int k = 0; k < viewpoints; ++k) {
        const MotionPoint way = direction(random);
        const double s = (std::isfinite(bound) ? 2 * bound : 1e6) * uniform(random, 0, 1);
        const MotionPoint p{s * way[0], s * way[1], s * way[2]};
        std::array<Row, 3> r;
        for (std::size_t i = 0; i < 3; ++i) r[i] = row_of(scene.s[i], p);
        const auto seen = [&](std::size_t i) { return Seen{&scene.s[i], &r[i]}; };
        const bool holds =
            of_edge ? decide.edge_length(seen(0), seen(1), p) : decide.facing(seen(0), seen(1), seen(2), p) > 0;
        ++(holds ? held : violated);
        ASSERT_TRUE(holds || s * (1 + 0x1p-50) >= bound) << made;
      }
    }
  }
  for (const auto branch :
       {exact::EdgeBranch::violated, exact::EdgeBranch::end_point, exact::EdgeBranch::tube,
        exact::EdgeBranch::cone_side, exact::EdgeBranch::cone_apex, exact::EdgeBranch::never_changes}) {
    EXPECT_GT(branches[branch], 0) << static_cast<int>(branch);
    std::printf("branch %d: %d edges\n", static_cast<int>(branch), branches[branch]);
  }
  EXPECT_GT(violated, held / 100);
  std::printf("%llu viewpoints hold, %llu violate, none of these nearer than the bound\n",
              static_cast<unsigned long long>(held), static_cast<unsigned long long>(violated));
}

TEST(FastBounds, NoViewpointViolatesNearerThanTheBound) { compare_with_viewpoints(2000, 100, 12); }
TEST(FastBoundsLong, TenThousandTrianglesAndEdgesAgainstTenThousandViewpointsEach) {
  compare_with_viewpoints(10'000, 10'000, 13);
}

// Were the bounds of tests above far too small, they would say nothing: a twentieth more is found out.
TEST(FastBounds, ATwentiethMoreIsFoundOut) {
  EXPECT_GT(adversarial_viewpoints(20'000, 256, 9, true, 1.05).violations, 0U);
}

// How tight: the bound as a part of the nearest violation, or loss of facing, that is found by going out along the worst directions; medians by angular size.
TEST(FastBoundsLong, TightnessOfTheDelaunayBoundByAngularSize) {
  fuzz::Random random(11);
  Constraints decide({0, 0, true});
  for (const char* kind : {"plane wall", "depth +-10 %", "depth x0.5 to 2", "one or two directions"}) {
    std::printf("| %s |", kind);
    for (const double size : {0.3, 0.1, 0.03, 0.01}) {
      std::vector<double> tightness;
      while (tightness.size() < 200) {
        Scene scene;
        int far = random.between(1, 2);
        for (DepthSample& s : scene.s) {
          const MotionPoint d = direction(random);
          const double x = d[0] * size, y = d[1] * size;
          const double depth = kind[0] == 'p'   ? 1 / (1 - 0.5 * x - 0.3 * y)
                               : kind[6] == '+' ? 1 + 0.1 * d[2]
                                                : std::exp2(uniform(random, -1, 1));
          s.is_direction = kind[0] == 'o' && far-- > 0;
          s.at = {x * depth, y * depth, depth};
        }
        turn_to_face(scene);
        const auto holds = [&](const MotionPoint& p) {
          std::array<Row, 4> r;
          for (std::size_t i = 0; i < 4; ++i) r[i] = row_of(scene.s[i], p);
          const auto seen = [&](std::size_t i) { return Seen{&scene.s[i], &r[i]}; };
          return decide.facing(seen(0), seen(1), seen(2), p) > 0 && decide.facing(seen(3), seen(2), seen(1), p) > 0 &&
                 decide.delaunay(seen(0), seen(1), seen(2), seen(3), p) >= 0;
        };
        if (!holds({})) continue;
        const auto r = scene.rows();
        const double bound = std::min(
            {delaunay_bound(r[0], r[1], r[2], r[3]), facing_bound(r[0], r[1], r[2]), facing_bound(r[3], r[2], r[1])});
        double reached = bound;
        for (bool found = false; !found && reached < 2; reached *= 1.02) {
          for (int start = 0; start < 40 && !found; ++start) {
            MotionPoint way = direction(random);
            if (start < 4)
              way = worst_on_sphere(scene, reached, way, [&](const auto& p) { return delaunay_of_units(scene, p); });
            found = !holds({reached * way[0], reached * way[1], reached * way[2]});
          }
        }
        tightness.push_back(bound / reached);
      }
      std::nth_element(tightness.begin(), tightness.begin() + 100, tightness.end());
      EXPECT_GT(tightness[100], 0.4);
      std::printf(" %.2f |", tightness[100]);
    }
    std::printf("\n");
  }
}

// What the bound is scaled by: lengths times a power of two.
TEST(FastBounds, ScaleWithTheScene) {
  fuzz::Random random(3);
  for (int k = 0; k < 500; ++k) {
    Scene scene = scene_of(random);
    turn_to_face(scene);
    for (auto& s : scene.s) s.is_direction = false;
    const auto rows = scene.rows();
    Scene large = scene;
    for (auto& s : large.s) {
      for (double& x : s.at) x *= 16;
    }
    for (double& x : large.v) x *= 16;
    const auto large_rows = large.rows();
    EXPECT_EQ(16 * triangle_bound(rows[0], rows[1], rows[2], BoundThresholds({})),
              triangle_bound(large_rows[0], large_rows[1], large_rows[2], BoundThresholds({})));
    EXPECT_EQ(16 * delaunay_bound(rows[0], rows[1], rows[2], rows[3]),
              delaunay_bound(large_rows[0], large_rows[1], large_rows[2], large_rows[3]));
  }
}

// The constants of T9, form 3: 3 c (1 - c^2) / 6 <= kThird for all cosines c; and 3 is the most that 9 (1 - z)(1 - 2 z + 5 z^2) for z = c^2 has as a root.
TEST(FastBounds, ConstantsOfTheThirdDerivativeOfALength) {
  long double most = 0, gradient = 0;
  for (int k = 0; k <= 1'000'000; ++k) {
    const long double c = k * 1e-6L, z = c * c;
    most = std::max(most, c * (1 - z) / 2);
    gradient = std::max(gradient, 9 * (1 - z) * (1 - 2 * z + 5 * z * z));
  }
  EXPECT_LT(most, 0.192451L);
  EXPECT_GT(most, 0.192449L);
  EXPECT_EQ(gradient, 9);
}

}  // namespace
}  // namespace clues::tests
