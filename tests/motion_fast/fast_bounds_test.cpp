// Motion bounds in doubles against exact arithmetic (D29, T8, T9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "exact/motion/compare_bounds.h"
#include "fastpath/motion/bounds.h"
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
      tight_edges += exact::compare_edge_bound(scene.s[0], scene.s[1], v, exact_limits, squared(e * (1 + 1e-3))) <= 0;
    } else if (e > 0) {
      EXPECT_TRUE(scene.s[0].is_direction && scene.s[1].is_direction);
    }
  }
  EXPECT_GT(facing, 3000);
  EXPECT_GT(edges, 700);
  EXPECT_GT(tight_facing, facing * 8 / 10);
  EXPECT_GT(tight_edges, edges * 3 / 10);  // the others: branch I1, where an end of the edge is nearer than the tube
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

// The constants of delaunay_bound.cpp for angles of at most 30 degrees: 1 - cos t <= 0.536 sin^2 t, 2 sin(t/2) <= 1.0353 sin t. Both quotients grow with t.
TEST(FastBounds, ConstantsOfAnglesUpToThirtyDegrees) {
  const long double t = std::acos(-1.0L) / 6;
  EXPECT_GT(0.536L * std::sin(t) * std::sin(t), 1 - std::cos(t));
  EXPECT_LT(0.5358L * std::sin(t) * std::sin(t), 1 - std::cos(t));
  EXPECT_GT(1.0353L * std::sin(t), 2 * std::sin(t / 2));
  EXPECT_LT(1.0352L * std::sin(t), 2 * std::sin(t / 2));
}

}  // namespace
}  // namespace clues::tests
