// The bounds of the reference against brute force: exact predicates at viewpoints just within and just beyond what is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "exact/motion/rational_vector.h"
#include "fuzz/generators/random.h"
#include "fuzz/motion/motion_cases.h"
#include "reference/motion/bounds.h"
#include "reference/motion/mesh.h"
#include "validate/motion/counterexample.h"
#include "validate/motion/mesh_places.h"

namespace clues {
namespace {

using exact::ExactThresholds;
using scene::MotionConstraint;
using scene::MotionPoint;
using Samples = std::array<const scene::DepthSample*, 4>;

MotionPoint unit(fuzz::Random& random) {
  MotionPoint out{};
  double square = 0;
  do {
    square = 0;
    for (double& x : out) {
      x = static_cast<double>(static_cast<std::int64_t>(random.next() >> 11)) * 0x1p-52 - 1;
      square += x * x;
    }
  } while (square > 1 || square < 0.01);
  for (double& x : out) x /= std::sqrt(square);
  return out;
}

// center + w for a w of doubles: rational, as exact as it gets.
exact::ExactViewpoint moved(const MotionPoint& center, const MotionPoint& direction, double far) {
  auto v = exact::exact_viewpoint(center);
  for (std::size_t i = 0; i < 3; ++i) v[i] += mpq_class(direction[i] * far);
  return v;
}

// How many of `tries` viewpoints on the sphere just within `bound` violate; the first at the counterexample that a search finds.
int violations_within(MotionConstraint constraint, const Samples& samples, const fuzz::MotionCase& test, double bound,
                      int tries, fuzz::Random& random) {
  if (bound == 0) return 0;
  const ExactThresholds thresholds(test.thresholds);
  const double far = std::isinf(bound) ? 1e6 : bound * (1 - 0x1p-48);
  int bad = 0;
  for (int n = 0; n < tries; ++n) {
    const auto v = moved(test.viewpoint, unit(random), far);
    if (!validate::holds_at(constraint, samples, v, thresholds)) ++bad;
  }
  return bad;
}

TEST(EdgeBound, TakesEveryBranchAndIsTheLargestDouble) {
  fuzz::Random random(11);
  std::map<exact::EdgeBranch, int> branches;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 5, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto v = exact::exact_viewpoint(test.viewpoint);
    auto a = test.mesh.samples[1], b = test.mesh.samples[2];
    if (n % 20 == 9) a.is_direction = b.is_direction = true;
    if (n % 20 == 19) {
      // One direction, on the other side.
      a.is_direction = true;
      b.is_direction = false;
      for (double& x : a.at) x = -x;
    }
    const auto branch = exact::edge_branch(a, b, v, thresholds);
    ++branches[branch];
    const double bound = reference::edge_bound(a, b, v, thresholds);
    ASSERT_EQ(bound, reference::edge_bound(b, a, v, thresholds));
    const Samples samples{&a, &b};
    ASSERT_EQ(violations_within(MotionConstraint::edge_length, samples, test, bound, 20, random), 0) << n;
    if (branch == exact::EdgeBranch::never_changes) {
      ASSERT_TRUE(std::isinf(bound));
      continue;
    }
    if (branch == exact::EdgeBranch::violated) {
      ASSERT_EQ(bound, 0) << n;
      ASSERT_FALSE(validate::holds_at(MotionConstraint::edge_length, samples, v, thresholds));
      continue;
    }
    // One unit in the last place more, and a viewpoint is found that violates.
    const double more = std::nextafter(bound, std::numeric_limits<double>::infinity());
    const auto found = validate::find_violation(
        {MotionConstraint::edge_length, samples, test.viewpoint, std::nextafter(more, 2 * more)}, thresholds);
    ASSERT_TRUE(found) << n << " bound " << bound << " branch " << static_cast<int>(branch);
  }
  for (const auto branch : {exact::EdgeBranch::violated, exact::EdgeBranch::end_point, exact::EdgeBranch::tube,
                            exact::EdgeBranch::cone_side, exact::EdgeBranch::never_changes}) {
    EXPECT_GT(branches[branch], 20) << static_cast<int>(branch);
  }
  EXPECT_GT(branches[exact::EdgeBranch::cone_apex], 5);
}

TEST(FacingBound, IsTheLargestDouble) {
  fuzz::Random random(12);
  int finite = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 6, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto& s = test.mesh.samples;
    const double bound = reference::facing_bound(s[0], s[1], s[2], exact::exact_viewpoint(test.viewpoint));
    const Samples samples{s.data(), &s[1], &s[2]};
    ASSERT_GT(bound, 0) << n;
    ASSERT_EQ(violations_within(MotionConstraint::facing, samples, test, bound, 20, random), 0) << n;
    if (std::isinf(bound)) continue;
    ++finite;
    const double more = std::nextafter(bound, 2 * bound);
    ASSERT_TRUE(validate::find_violation(
        {MotionConstraint::facing, samples, test.viewpoint, std::nextafter(more, 2 * more)}, thresholds))
        << n;
  }
  EXPECT_GT(finite, 900);
}

// Two largest doubles away: farther than any double says, and yet not for ever.
TEST(FacingBound, IsFiniteBeyondTheLargestDouble) {
  constexpr double far = 0x1.fp1023, size = 0x1p1000;
  const scene::DepthSample a{{far, 0, 0}}, b{{far, size, 0}}, c{{far, 0, size}};
  const exact::ExactViewpoint v = exact::exact_viewpoint({-far, 0, 0});
  EXPECT_EQ(reference::facing_bound(a, b, c, v), std::numeric_limits<double>::max());
  const scene::DepthSample x{{1, 0, 0}, true}, y{{0, 1, 0}, true}, z{{0, 0, 1}, true};
  EXPECT_EQ(reference::facing_bound(x, y, z, v), std::numeric_limits<double>::infinity());
}

// Closed forms. The ball of radius 3 - 1/2^40 is proved, 3 is the bound.
TEST(Bounds, ClosedForms) {
  const auto origin = exact::exact_viewpoint({0, 0, 0});
  const scene::DepthSample a{{0, 0, 3}}, b{{1, 0, 3}}, c{{0, 1, 3}};
  EXPECT_EQ(reference::facing_bound(a, b, c, origin), 3);
  EXPECT_EQ(reference::facing_bound(a, c, b, origin), 0);
  // phi = 90 degrees: the sphere over the edge, radius 1, from its centre and from half way out.
  const scene::DepthSample left{{-1, 0, 0}}, right{{1, 0, 0}};
  const ExactThresholds right_angle({0, 0, false});
  EXPECT_EQ(reference::edge_bound(left, right, origin, right_angle), 1);
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({0, 0.5, 0}), right_angle), 0.5);
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({0, 2, 0}), right_angle), 0);
  // kappa = 3/4: R = 5/4, h = 3/4. On the axis of the circle's centre: R; on the axis between the ends: the nearer end.
  const ExactThresholds sharp({0.75, 0, false});
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({0, 0.75, 0}), sharp), 1.25);
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({0.25, 0, 0}), sharp), 0.75);
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({0, 1.75, 0}), sharp), 0.25);
  // kappa = -3/4, a lemon: R = 5/4, h = -3/4, at the middle of the edge 1/2.
  EXPECT_EQ(reference::edge_bound(left, right, origin, ExactThresholds({-0.75, 0, false})), 0.5);
  // One end at infinity above, kappa = 3/4: sin(phi) = 4/5, cos(phi) = 3/5. p sideways: 3/5 |p|; p straight behind: the apex.
  const scene::DepthSample up{{0, 0, 7}, true, false}, aside{{5, 0, 0}}, behind{{0, 0, -5}};
  EXPECT_EQ(reference::edge_bound(up, aside, origin, sharp), 3);
  EXPECT_EQ(reference::edge_bound(up, behind, origin, sharp), 5);
  EXPECT_EQ(reference::edge_bound(up, scene::DepthSample{{0, 1, 0}, true, false}, origin, sharp),
            std::numeric_limits<double>::infinity());
  // Standing on a sample, and an edge without length.
  EXPECT_EQ(reference::edge_bound(left, right, exact::exact_viewpoint({1, 0, 0}), sharp), 0);
  EXPECT_EQ(reference::edge_bound(left, left, origin, sharp), 0);
}

struct LowerBounds {
  std::uint64_t viewpoints = 0, violations = 0, positive = 0, chord_unsound = 0, chord_cases = 0;
};

// What the sketch takes for the separation: the edge length bound of the chord from p to the foot of its perpendicular.
double chord_bound(const scene::DepthSample& a, const scene::DepthSample& b, const scene::DepthSample& p,
                   const exact::ExactViewpoint& v, const ExactThresholds& thresholds) {
  MotionPoint foot{};
  double along = 0, square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (p.at[i] - a.at[i]) * (b.at[i] - a.at[i]);
    square += (b.at[i] - a.at[i]) * (b.at[i] - a.at[i]);
  }
  const double t = along / square;
  if (!(t > 0 && t < 1)) return -1;
  for (std::size_t i = 0; i < 3; ++i) foot[i] = a.at[i] + t * (b.at[i] - a.at[i]);
  ExactThresholds chord = thresholds;
  chord.kappa = std::sqrt((1 - thresholds.sigma.get_d()) / thresholds.sigma.get_d());
  return reference::edge_bound(p, {foot}, v, chord);
}

TEST(SeparationBound, NothingNearerViolates) {
  fuzz::Random random(13);
  int positive = 0;
  for (std::uint64_t n = 0; n < 400; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 7, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto& s = test.mesh.samples;
    const double bound =
        reference::separation_bound(s[0], s[1], s[2], exact::exact_viewpoint(test.viewpoint), thresholds);
    positive += bound > 0 ? 1 : 0;
    ASSERT_LE(bound, reference::facing_bound(s[0], s[1], s[2], exact::exact_viewpoint(test.viewpoint))) << n;
    const Samples samples{&s[2], s.data(), &s[1]};
    ASSERT_EQ(violations_within(MotionConstraint::separation, samples, test, bound, 50, random), 0) << n;
    if (bound > 0 && n % 4 == 0) {
      ASSERT_FALSE(validate::find_violation(
          {MotionConstraint::separation, samples, test.viewpoint, std::min(bound, 1e6)}, thresholds))
          << n;
    }
  }
  EXPECT_GT(positive, 300);
}

// Planted: the chord bound is caught by the search in more than half of all triangles with the foot within the edge.
TEST(SeparationBound, TheChordBoundIsCaughtInMoreThanHalf) {
  int caught = 0, caught_while_facing = 0, cases = 0;
  for (std::uint64_t n = 0; cases < 120; ++n) {
    auto test = fuzz::motion_case(fuzz::MotionKind::random, 8, n);
    test.thresholds.sigma = 0.0019;  // eps = 0.0436
    const ExactThresholds thresholds(test.thresholds);
    const auto& s = test.mesh.samples;
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const double chord = chord_bound(s[0], s[1], s[2], v, thresholds);
    const Samples samples{&s[2], s.data(), &s[1]};
    if (!(chord > 0) || !validate::holds_at(MotionConstraint::separation, samples, v, thresholds)) continue;
    ++cases;
    const auto refuted = [&](double bound) {
      return validate::find_violation({MotionConstraint::separation, samples, test.viewpoint, bound}, thresholds) ? 1
                                                                                                                  : 0;
    };
    caught += refuted(chord);
    // Even where the facing bound is kept besides.
    caught_while_facing += refuted(std::min(chord, reference::facing_bound(s[0], s[1], s[2], v)));
  }
  EXPECT_GT(2 * caught, cases);
  EXPECT_GT(3 * caught_while_facing, cases);
  std::printf("of %d chord bounds %d are refuted, %d within the facing bound\n", cases, caught, caught_while_facing);
}

// The example that refutes the sketch.
TEST(SeparationBound, TheCounterexampleToTheSketch) {
  const scene::DepthSample p{{-0.727226, -0.232915, -0.547685}}, a{{-1.255267, -0.373920, -1.023246}},
      b{{-0.848044, -0.692029, -0.964310}};
  const double eps = 0.043680;
  const ExactThresholds thresholds({1 / std::tan(eps), std::sin(eps) * std::sin(eps), false});
  const auto origin = exact::exact_viewpoint({0, 0, 0});
  // Whichever way round the triangle is given, it faces one way.
  const bool forward = reference::facing_bound(a, b, p, origin) > 0;
  const auto &first = forward ? a : b, &second = forward ? b : a;
  const double chord = chord_bound(first, second, p, origin, thresholds);
  EXPECT_NEAR(chord, 0.412366, 1e-5);
  const auto bad = exact::exact_viewpoint({-0.047354, -0.048221, 0.066885});
  EXPECT_FALSE(validate::holds_at(MotionConstraint::separation, {&p, &a, &b}, bad, thresholds));
  EXPECT_TRUE(validate::holds_at(MotionConstraint::separation, {&p, &a, &b}, origin, thresholds));
  EXPECT_LT(reference::separation_bound(first, second, p, origin, thresholds), 0.0951);
}

TEST(DelaunayBound, NothingNearerViolates) {
  fuzz::Random random(14);
  int positive = 0, cases = 0;
  for (std::uint64_t n = 0; n < 120; ++n) {
    const auto kind = static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds);
    const auto test = fuzz::motion_case(kind, 9, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto& s = test.mesh.samples;
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const Samples samples{s.data(), &s[1], &s[2], &s[3]};
    const double bound = reference::delaunay_bound(s[0], s[1], s[2], s[3], v);
    if (!validate::holds_at(MotionConstraint::delaunay, samples, v, thresholds)) {
      ASSERT_EQ(bound, 0) << n;
      continue;
    }
    ++cases;
    positive += bound > 0 ? 1 : 0;
    ASSERT_EQ(violations_within(MotionConstraint::delaunay, samples, test, bound, 100, random), 0) << n;
    if (bound > 0 && std::isfinite(bound)) {
      ASSERT_FALSE(validate::find_violation({MotionConstraint::delaunay, samples, test.viewpoint, bound}, thresholds))
          << n;
    }
  }
  EXPECT_GT(cases, 40);
  EXPECT_GT(4 * positive, cases * 2);
}

// Of a triangle with two sides: opposite each edge is its own third corner.
TEST(DelaunayBound, TakesASampleThatIsThereTwice) {
  const scene::DepthSample a{{1, 0, 2}}, b{{0, 1, 2}}, c{{-1, -1, 3}}, again = c;
  const auto origin = exact::exact_viewpoint({0, 0, 0});
  const double bound = reference::delaunay_bound(a, b, c, c, origin);
  EXPECT_GE(bound, 0);
  EXPECT_EQ(bound, reference::delaunay_bound(a, b, c, again, origin));
}

// What the second form is for: small quadrangles on a wall keep their proportions, and the first form's do not.
TEST(DelaunayBound, KeepsItsProportionsWhenQuadranglesGetSmall) {
  const auto origin = exact::exact_viewpoint({0, 0, 0});
  double last = 0;
  for (const double size : {0x1p-3, 0x1p-6, 0x1p-9, 0x1p-12}) {
    const auto on_wall = [&](double x, double y) {
      const double depth = 2 / (1 - 0.5 * x * size - 0.25 * y * size);
      return scene::DepthSample{{x * size * depth, y * size * depth, depth}};
    };
    const auto forms =
        reference::delaunay_forms(on_wall(-1, -0.75), on_wall(0.25, -0.5), on_wall(-0.5, 0.5), on_wall(1, 1), origin);
    EXPECT_GT(forms.quadrangle, 0.05) << size;
    EXPECT_GT(forms.quadrangle, 2 * forms.general) << size;
    EXPECT_GT(forms.ball, 1.2 * forms.quadrangle) << size;
    if (last > 0) {
      EXPECT_GT(forms.quadrangle, 0.8 * last) << size;
    }
    last = forms.quadrangle;
  }
}

// Motion of everything by amounts that doubles add exactly, and scaling by powers of two, change bounds by nothing and by that power.
TEST(Bounds, MoveAndScaleWithTheScene) {
  for (std::uint64_t n = 0; n < 10; ++n) {
    auto test = fuzz::motion_case(fuzz::MotionKind::random, 10, n);
    for (auto& sample : test.mesh.samples) {
      for (double& x : sample.at) x = std::ldexp(std::round(std::ldexp(x, 20)), -20);
    }
    const auto before = reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
    auto other = test;
    const MotionPoint by{3, -17.5, 0.25};
    for (auto& sample : other.mesh.samples) {
      for (std::size_t i = 0; i < 3; ++i) sample.at[i] += by[i];
    }
    for (std::size_t i = 0; i < 3; ++i) other.viewpoint[i] += by[i];
    EXPECT_EQ(before, reference::motion_bounds(other.mesh, other.thresholds, exact::exact_viewpoint(other.viewpoint)));
    other = test;
    for (auto& sample : other.mesh.samples) {
      for (double& x : sample.at) x = std::ldexp(x, 37);
    }
    for (double& x : other.viewpoint) x = std::ldexp(x, 37);
    auto after = reference::motion_bounds(other.mesh, other.thresholds, exact::exact_viewpoint(other.viewpoint));
    for (double& x : after) x = std::ldexp(x, -37);
    EXPECT_EQ(before, after);
  }
}

// The figures of docs/motion.md: 10,000 edges and triangles; tightness by angular size.
TEST(BoundsLong, TenThousandEdgesAgainstTenThousandViewpointsInAll) {
  fuzz::Random random(21);
  std::map<exact::EdgeBranch, int> branches;
  std::uint64_t viewpoints = 0;
  for (std::uint64_t n = 0; n < 10'000; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 22, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const auto& s = test.mesh.samples;
    ++branches[exact::edge_branch(s[1], s[2], v, thresholds)];
    const int tries = 300;
    const Samples edge{&s[1], &s[2]}, triangle{s.data(), &s[1], &s[2]}, separation{&s[2], s.data(), &s[1]};
    ASSERT_EQ(0, violations_within(MotionConstraint::edge_length, edge, test,
                                   reference::edge_bound(s[1], s[2], v, thresholds), tries, random))
        << n;
    ASSERT_EQ(0, violations_within(MotionConstraint::facing, triangle, test,
                                   reference::facing_bound(s[0], s[1], s[2], v), tries, random))
        << n;
    ASSERT_EQ(0, violations_within(MotionConstraint::separation, separation, test,
                                   reference::separation_bound(s[0], s[1], s[2], v, thresholds), tries, random))
        << n;
    viewpoints += 3 * tries;
  }
  for (const auto& [branch, count] : branches) std::printf("branch %d: %d\n", static_cast<int>(branch), count);
  std::printf("%llu viewpoints\n", static_cast<unsigned long long>(viewpoints));
}

// How far from a violation a constraint is, in doubles: only to choose where to look.
double slack(MotionConstraint constraint, const Samples& samples, const exact::ExactViewpoint& v) {
  std::array<MotionPoint, 4> u{};
  for (std::size_t i = 0; i < 4 && samples[i]; ++i) {
    const auto row = exact::seen(*samples[i], v);
    const MotionPoint x{row[0].get_d(), row[1].get_d(), row[2].get_d()};
    const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (std::size_t k = 0; k < 3; ++k) u[i][k] = x[k] / length;
  }
  if (constraint == MotionConstraint::delaunay) {
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) u[i][k] -= u[0][k];
    }
    std::swap(u[0], u[3]);
  }
  const double det = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
                     u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
                     u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
  return constraint == MotionConstraint::delaunay ? -det : det;
}

// Half of the viewpoints crowd around the worst of fifty directions.
void adversarial(MotionConstraint constraint, int bounds, int tries) {
  fuzz::Random random(31);
  std::uint64_t viewpoints = 0;
  int made = 0;
  for (std::uint64_t n = 0; made < bounds; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 32, n);
    const ExactThresholds thresholds(test.thresholds);
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const auto& s = test.mesh.samples;
    const bool delaunay = constraint == MotionConstraint::delaunay;
    const double bound = delaunay ? reference::delaunay_bound(s[0], s[1], s[2], s[3], v)
                                  : reference::separation_bound(s[0], s[1], s[2], v, thresholds);
    if (bound == 0 || std::isinf(bound)) continue;
    ++made;
    Samples samples{&s[2], s.data(), &s[1]};
    if (delaunay) samples = {s.data(), &s[1], &s[2], &s[3]};
    const double far = bound * (1 - 0x1p-48);
    MotionPoint worst = unit(random);
    for (int k = 0; k < 50; ++k) {
      const auto other = unit(random);
      if (slack(constraint, samples, moved(test.viewpoint, other, far)) <
          slack(constraint, samples, moved(test.viewpoint, worst, far))) {
        worst = other;
      }
    }
    for (int k = 0; k < tries; ++k) {
      auto direction = unit(random);
      if (k % 2 == 0) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          direction[i] = worst[i] + std::ldexp(direction[i], -(k / 2 % 20));
          square += direction[i] * direction[i];
        }
        for (double& x : direction) x *= (1 - 0x1p-48) / std::sqrt(square);
      }
      ASSERT_TRUE(validate::holds_at(constraint, samples, moved(test.viewpoint, direction, far), thresholds)) << n;
      ++viewpoints;
    }
  }
  std::printf("%llu viewpoints at %d bounds, no violation\n", static_cast<unsigned long long>(viewpoints), made);
}

TEST(SeparationBoundLong, FiveMillionAdversarialViewpoints) { adversarial(MotionConstraint::separation, 1000, 5000); }
TEST(DelaunayBoundLong, FiveMillionAdversarialViewpoints) { adversarial(MotionConstraint::delaunay, 1000, 5000); }

TEST(DelaunayBoundLong, TightnessByAngularSize) {
  fuzz::Random random(23);
  for (const bool wall : {true, false}) {
    for (const double size : {0.3, 0.1, 0.03, 0.01}) {
      std::vector<double> tightness, general;
      std::uint64_t viewpoints = 0;
      while (tightness.size() < 200) {
        std::array<scene::DepthSample, 4> s;
        for (auto& sample : s) {
          const auto at = unit(random);
          const double x = at[0] * size, y = at[1] * size;
          const double depth = wall ? 1 / (1 - 0.5 * x - 0.3 * y) : 1 + 0.1 * at[2];
          sample.at = {x * depth, y * depth, depth};
        }
        const ExactThresholds thresholds({0, 0, true});
        const Samples all{s.data(), &s[1], &s[2], &s[3]}, one{s.data(), &s[1], &s[2]}, two{&s[3], &s[2], &s[1]};
        const auto origin = exact::exact_viewpoint({0, 0, 0});
        const auto valid = [&](const exact::ExactViewpoint& v) {
          return validate::holds_at(MotionConstraint::facing, one, v, thresholds) &&
                 validate::holds_at(MotionConstraint::facing, two, v, thresholds) &&
                 validate::holds_at(MotionConstraint::delaunay, all, v, thresholds);
        };
        if (!valid(origin)) continue;
        const auto forms = reference::delaunay_forms(s[0], s[1], s[2], s[3], origin);
        const double bound = std::min({std::max({forms.general, forms.quadrangle, forms.ball}),
                                       reference::facing_bound(s[0], s[1], s[2], origin),
                                       reference::facing_bound(s[3], s[2], s[1], origin)});
        double nearest = 2;
        for (int n = 0; n < 400; ++n) {
          const auto direction = unit(random);
          ASSERT_TRUE(valid(moved({0, 0, 0}, direction, bound * (1 - 0x1p-48))));
          ++viewpoints;
          for (double far = bound; far < nearest; far *= 1.05) {
            if (!valid(moved({0, 0, 0}, direction, far))) nearest = far;
          }
        }
        tightness.push_back(bound / nearest);
        general.push_back(std::min(forms.general, bound) / nearest);
      }
      std::sort(tightness.begin(), tightness.end());
      std::sort(general.begin(), general.end());
      std::printf("%s, size %.2f: %.3f of the nearest violation (form 1 alone %.3f)\n", wall ? "wall" : "depth", size,
                  tightness[100], general[100]);
    }
  }
}

}  // namespace
}  // namespace clues
