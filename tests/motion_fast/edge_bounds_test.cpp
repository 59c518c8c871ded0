// Bounds along needles (T14): what a gauge says of a step, how far a model says the viewpoint may go, and which edges are due on the way, each against exact arithmetic.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "exact/motion/constraints.h"
#include "fastpath/motion/bounds/bounds.h"
#include "fastpath/motion/bounds/edge_bounds.h"
#include "fastpath/motion/bounds/predicates.h"
#include "tests/motion_fast/exact_checks.h"

namespace clues::tests {
namespace {

using namespace fastpath::motion;
using Exact = std::array<mpq_class, 3>;

Vec vec(const MotionPoint& p) { return {p[0], p[1], p[2]}; }
Exact exact_vec(const Vec& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }

Gauge gauge_of(fuzz::Random& random) {
  if (random.one_in(6)) return {};
  const double head = std::ldexp(1, -static_cast<int>(random.between(0, 6)));
  return {vec(direction(random)), std::ldexp(head, -static_cast<int>(random.between(0, 4))), head};
}

Vec step_of(fuzz::Random& random, const Gauge& gauge) {
  const int least = random.one_in(4) ? 1074 : 30;
  const Vec any = std::ldexp(1, -static_cast<int>(random.between(0, least))) * vec(direction(random));
  if (random.one_in(3)) return any;
  return std::ldexp(1, static_cast<int>(random.between(-4, 4))) * (gauge.u + any);
}

// Whether w is in t B: with the d that gauge_up() takes, which may be any.
bool in_body(const Exact& w, const mpq_class& d, const mpq_class& t, const Gauge& gauge) {
  const Exact u = exact_vec(gauge.u);
  mpq_class away = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const mpq_class e = w[i] - d * u[i];
    away += e * e;
  }
  const mpq_class radius = mpq_class(gauge.tail) * t + (mpq_class(gauge.head) - mpq_class(gauge.tail)) * d;
  return d >= 0 && d <= t && away <= radius * radius;
}

TEST(EdgeBounds, StepsAndTheirSumsAreInTheBodiesOfTheirGauges) {
  fuzz::Random random(1);
  int longer = 0;
  for (int k = 0; k < 40000; ++k) {
    const Gauge gauge = gauge_of(random);
    const Vec first = step_of(random, gauge), second = step_of(random, gauge);
    const double t = gauge_up(gauge, first), more = gauge_up(gauge, second);
    const auto along = [&](const Vec& w) { return mpq_class(std::max(0.0, dot(w, gauge.u))); };
    ASSERT_TRUE(in_body(exact_vec(first), along(first), t, gauge)) << k;
    Exact sum = exact_vec(first);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += exact_vec(second)[i];
    ASSERT_TRUE(in_body(sum, along(first) + along(second), mpq_class(t) + mpq_class(more), gauge)) << k;
    const bool tiny = norm(first) < 0x1p-450;  // squares underflow
    longer += !tiny && in_body(exact_vec(first), along(first), mpq_class(t * (1 - 1e-9)), gauge) ? 1 : 0;
  }
  EXPECT_EQ(longer, 0);  // none is too long by more than that
}

struct Quadrangle {
  std::array<DepthSample, 4> s;
  DelaunayModel model_at(const MotionPoint& v) const {
    return delaunay_model(row_of(s[0], v), row_of(s[1], v), row_of(s[2], v), row_of(s[3], v));
  }
  int sign_at(const MotionPoint& v) const {
    return exact::delaunay_sign(exact::sight_row(s[0], v), exact::sight_row(s[1], v), exact::sight_row(s[2], v),
                                exact::sight_row(s[3], v));
  }
};

// Two triangles seen from the origin, of some angle, at depths that vary.
Quadrangle quadrangle_of(fuzz::Random& random) {
  constexpr std::array angles{0.3, 0.1, 0.03, 0.01, 1e-4};
  constexpr std::array depths{0.0, 0.02, 0.1, 0.5};
  const double angle = angles[static_cast<std::size_t>(random.between(0, 4))];
  const double depth = depths[static_cast<std::size_t>(random.between(0, 3))];
  const double size = std::ldexp(1, static_cast<int>(random.between(-3, 3)) * (random.one_in(10) ? 10 : 1));
  const MotionPoint d = direction(random), n = direction(random);
  Quadrangle q;
  for (DepthSample& s : q.s) {
    const MotionPoint off = direction(random);
    for (std::size_t i = 0; i < 3; ++i) s.at[i] = d[i] + angle * off[i];
    s.is_direction = random.one_in(12);
    const double across = s.at[0] * n[0] + s.at[1] * n[1] + s.at[2] * n[2];
    const double far =
        depth == 0 && std::fabs(across) > 0.2 ? 1 / std::fabs(across) : 1 + depth * uniform(random, -1, 1);
    for (double& x : s.at) x *= size * far;
  }
  const auto row = [&](std::size_t i) { return exact::sight_row(q.s[i], MotionPoint{0, 0, 0}); };
  if (exact::facing_sign(row(0), row(1), row(2)) < 0) std::swap(q.s[1], q.s[2]);
  return q;
}

struct NeedleAttack {
  int bounds = 0, further_than_the_ball = 0, violations = 0;
};

// G of the four in units of their lengths: as the filter sees it, which is enough to look for the worst place.
double value_at(const Quadrangle& q, const Vec& w) {
  std::array<Row, 4> r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = row_of(q.s[i], {w.x, w.y, w.z});
  return delaunay_value(r[0], r[1], r[2], r[3]) / ((r[0].length * r[1].length) * (r[2].length * r[3].length));
}

// The place (share of d, direction off the axis) with the least value that a climb from there finds.
template <class Place>
Vec worst_near(const Quadrangle& q, fuzz::Random& random, double share, Vec off, const Place& place) {
  Vec worst = place(share, off);
  double least = value_at(q, worst);
  double reach = 0.5;
  for (int k = 0; k < 200; ++k) {
    const double next = std::clamp(share + reach * uniform(random, -1, 1), 0.0, 1.0);
    const Vec turned = off + reach * vec(direction(random));
    const Vec w = place(next, turned);
    const double value = value_at(q, w);
    if (value < least) {
      least = value;
      worst = w;
      share = next;
      off = turned;
    } else {
      reach *= 0.9;
    }
  }
  return worst;
}

// Viewpoints on the surface of t B times a factor: some by chance, half of them where the model falls most, and where climbs from there end.
NeedleAttack attack_needles(int wanted, double factor, std::uint64_t seed) {
  fuzz::Random random(seed);
  NeedleAttack sum;
  while (sum.bounds < wanted) {
    const Quadrangle q = quadrangle_of(random);
    const DelaunayModel model = q.model_at({0, 0, 0});
    Gauge gauge = gauge_of(random);
    const double slope = norm(model.slope);
    if (random.one_in(3) && slope > 0 && norm(gauge.u) > 0)
      gauge.u = (random.one_in(2) ? 1 / slope : -1 / slope) * model.slope;
    const Reaches reaches(model);
    const double t = reaches.of(gauge);
    if (!(t > 0) || !std::isfinite(t)) continue;
    ++sum.bounds;
    sum.further_than_the_ball += t > reaches.of({}) ? 1 : 0;
    const bool is_needle = norm(gauge.u) > 0;
    const auto place = [&](double share, const Vec& off) {
      const double d = is_needle ? share * t : 0;
      const Vec aside = off - dot(off, gauge.u) * gauge.u;
      const double radius = gauge.tail * t + d * (gauge.head - gauge.tail), length = norm(aside);
      return factor * (1 - 1e-12) * (d * gauge.u + (length > 0 ? radius / length : 0) * aside);
    };
    for (int k = 0; k < 24; ++k) {
      const double share = random.one_in(2) ? 1 : random.one_in(2) ? 0 : uniform(random, 0, 1);
      Vec off = vec(direction(random));
      if (k % 2 == 0 && slope > 0) off = (-1 / slope) * model.slope + std::ldexp(1, -(k % 16)) * off;
      const Vec w = k % 4 == 0 ? worst_near(q, random, share, off, place) : place(share, off);
      sum.violations += q.sign_at({w.x, w.y, w.z}) < 0 ? 1 : 0;
    }
  }
  return sum;
}

TEST(EdgeBounds, NoViewpointInANeedleViolatesAnything) {
  const NeedleAttack sum = attack_needles(20000, 1, 2);
  EXPECT_EQ(sum.violations, 0);
  EXPECT_GT(sum.further_than_the_ball, 7000);
}

TEST(EdgeBoundsLong, NoViewpointInANeedleViolatesAnything) { EXPECT_EQ(attack_needles(200'000, 1, 3).violations, 0); }

TEST(EdgeBounds, AThousandthMoreIsFoundOut) { EXPECT_GT(attack_needles(3000, 1.001, 2).violations, 0); }

// Which edges hold, asked in each frame of those that are not due: all have to.
struct Looks {
  int computed = 0, unseen = 0, lost = 0;
};

Looks walk(const std::vector<MotionPoint>& path, bool with_needles, std::uint64_t seed) {
  fuzz::Random random(seed);
  std::vector<Quadrangle> edges;
  while (edges.size() < 150) {
    Quadrangle q = quadrangle_of(random);
    if (q.model_at({0, 0, 0}).value > 0) edges.push_back(q);
  }
  EdgeBounds bounds(0.002);
  bounds.resize(edges.size());
  const auto set = [&](std::uint32_t i, const MotionPoint& at) {
    const auto& s = edges[i].s;
    if (with_needles) {
      bounds.set(i, edges[i].model_at(at), at);
    } else {
      bounds.set_ball(i, delaunay_bound(row_of(s[0], at), row_of(s[1], at), row_of(s[2], at), row_of(s[3], at)), at);
    }
  };
  for (std::uint32_t i = 0; i < edges.size(); ++i) set(i, path[0]);
  Looks looks;
  std::vector<std::uint32_t> due;
  std::vector<bool> kept(edges.size(), true);
  for (std::size_t k = 1; k < path.size(); ++k) {
    bounds.move(path[k - 1], path[k]);
    due.clear();
    bounds.take_due(due);
    for (const std::uint32_t i : due) {
      if (bounds.has_some_left(i, path[k])) continue;
      ++looks.computed;
      if (edges[i].sign_at(path[k]) >= 0) {
        set(i, path[k]);
      } else {
        bounds.drop(i);
        kept[i] = false;
        ++looks.lost;
      }
    }
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      looks.unseen += kept[i] && edges[i].sign_at(path[k]) < 0 ? 1 : 0;
    }
  }
  return looks;
}

std::vector<MotionPoint> path_of(const char* kind, int frames) {
  fuzz::Random random(7);
  std::vector<MotionPoint> path{{0, 0, 0}};
  MotionPoint at{};
  for (int k = 1; k < frames; ++k) {
    const double angle = 0.01 * k;
    const MotionPoint any = direction(random);
    const bool turns = kind[0] == 't', jitters = kind[0] == 'j', random_walk = kind[0] == 'r', back = kind[0] == 'b';
    MotionPoint step{1, 0.3, -0.2};
    if (turns) step = {std::cos(angle), std::sin(angle), 0.1};
    if (jitters) step = {1 + 0.3 * any[0], 0.3 * any[1], 0.3 * any[2]};
    if (random_walk) step = any;
    if (back && k % 20 >= 10) step = {-1, -0.3, 0.2};
    if (kind[0] == 'h') {
      const double turn = 2.4 * static_cast<double>(k / 12);
      step = {0.02 * std::cos(turn), 0.02 * std::sin(turn), 0.02 * std::sin(0.7 * turn)};
    }
    if (k % 17 == 0 && !back) step = {};  // stands still
    for (std::size_t i = 0; i < 3; ++i) at[i] += 0.008 * step[i];
    path.push_back(at);
  }
  return path;
}

TEST(EdgeBounds, WhatIsNotDueHoldsHoweverTheViewpointGoes) {
  // The last one has more headings than there are bodies in use at a time, and on each of them it goes far enough for keys along it.
  for (const char* kind : {"straight", "turning", "jitter", "random", "back and forth", "headings"}) {
    const auto path = path_of(kind, kind[0] == 'h' ? 1200 : 200);
    const Looks with = walk(path, true, 4), balls = walk(path, false, 4);
    EXPECT_EQ(with.unseen, 0) << kind;
    EXPECT_EQ(balls.unseen, 0) << kind;
    EXPECT_GT(with.lost, 0) << kind;
    std::printf("%s: %d looks, %d with balls alone\n", kind, with.computed, balls.computed);
    if (kind[0] == 's' || kind[0] == 't') {
      EXPECT_LT(with.computed, 0.95 * balls.computed) << kind;
    } else {
      EXPECT_LT(with.computed, 2 * balls.computed) << kind;
    }
  }
}

}  // namespace
}  // namespace clues::tests
