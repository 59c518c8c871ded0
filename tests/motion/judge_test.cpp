// The judge of bounds: proves what is sound, refutes what is planted, and says what it could not decide.
#include "validate/motion/judge_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuzz/motion/motion_cases.h"
#include "reference/motion/mesh.h"
#include "scene/messages/error.h"
#include "validate/motion/ball_proof.h"
#include "validate/motion/mesh_places.h"

namespace clues {
namespace {

using validate::BoundVerdict;

std::vector<double> reference_bounds(const fuzz::MotionCase& test) {
  return reference::motion_bounds(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint));
}

validate::BoundsReport judged(const fuzz::MotionCase& test, const std::vector<double>& claims,
                              std::uint64_t most_cubes = 20'000) {
  validate::JudgeBoundsOptions options;
  options.threads = 1;
  options.most_cubes = most_cubes;
  return validate::judge_motion_bounds(test.mesh, test.thresholds, test.viewpoint, claims, options);
}

// Two ways to every lower bound: what the reference says is never refuted, and nearly always proved without its formulas.
TEST(JudgeOfBounds, ProvesTheReference) {
  int claims = 0, undecided = 0;
  for (std::uint64_t n = 0; n < 100; ++n) {
    const auto kind = static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds);
    const auto test = fuzz::motion_case(kind, 31, n);
    const auto bounds = reference_bounds(test);
    const auto report = judged(test, bounds, 2000);
    ASSERT_EQ(report.refuted, 0) << n << ": " << validate::to_text(report, test.mesh);
    for (const auto& triangle : report.triangles) {
      if (triangle.claim == 0) continue;
      ++claims;
      if (triangle.verdict != BoundVerdict::undecided) continue;
      ++undecided;
      // One unit in the last place from a circle there is less to prove than intervals of doubles can tell.
      if (kind != fuzz::MotionKind::one_ulp) {
        EXPECT_GT(triangle.proved, 0.5 * triangle.claim) << n;
      }
    }
  }
  EXPECT_GT(claims, 20);
  EXPECT_LT(5 * undecided, claims) << undecided << " of " << claims;
}

// Planted: a bound that is rounded up, where the bound is exact (facing or an edge length is the least).
TEST(JudgeOfBounds, RefutesOneUnitInTheLastPlace) {
  int exact_bounds = 0, refuted = 0;
  for (std::uint64_t n = 0; n < 120; ++n) {
    auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % 4), 32, n);
    test.thresholds.delaunay = false;
    test.thresholds.sigma = 0;
    auto claims = reference_bounds(test);
    if (claims[0] == 0) continue;
    claims[1] = 0;
    ++exact_bounds;
    EXPECT_EQ(judged(test, claims).proved, 2) << n;
    claims[0] = std::nextafter(claims[0], std::numeric_limits<double>::infinity());
    const auto report = judged(test, claims);
    // The bound itself may be a double; then one more is refuted.
    if (report.refuted == 0) {
      claims[0] = std::nextafter(claims[0], std::numeric_limits<double>::infinity());
      refuted += judged(test, claims).refuted == 1 ? 1 : 0;
    } else {
      ++refuted;
    }
  }
  EXPECT_GT(exact_bounds, 20);
  EXPECT_EQ(refuted, exact_bounds);
}

// Planted: bounds one and a half times too large are refuted mostly, and the viewpoint that is given is in the ball and violates.
TEST(JudgeOfBounds, RefutesWithAViewpointThatViolates) {
  int refuted = 0, claimed = 0;
  for (std::uint64_t n = 0; n < 100; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 33, n);
    auto claims = reference_bounds(test);
    // Of facing at least, so that a violation exists.
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const auto& s = test.mesh.samples;
    claims[0] = 1.5 * reference::facing_bound(s[0], s[1], s[2], v);
    claims[1] = 0;
    if (!std::isfinite(claims[0])) continue;
    ++claimed;
    const auto report = judged(test, claims);
    const auto& triangle = report.triangles[0];
    ASSERT_EQ(triangle.verdict, BoundVerdict::refuted) << n;
    ++refuted;
    const exact::ExactThresholds thresholds(test.thresholds);
    const validate::MeshPlaces places(test.mesh);
    const auto numbers = validate::samples_at(test.mesh, places, triangle.place);
    std::array<const scene::DepthSample*, 4> samples{};
    for (std::size_t i = 0; i < numbers.count; ++i) samples[i] = &s[numbers.sample[i]];
    EXPECT_FALSE(validate::holds_at(triangle.place.constraint, samples, triangle.viewpoint, thresholds));
    mpq_class far = 0;
    for (std::size_t i = 0; i < 3; ++i) far += (triangle.viewpoint[i] - v[i]) * (triangle.viewpoint[i] - v[i]);
    EXPECT_LT(far, mpq_class(claims[0]) * mpq_class(claims[0]));
  }
  EXPECT_GT(refuted, 80);
}

// "Everything holds for ever" and "nothing is known" must not pass as the same.
TEST(JudgeOfBounds, ConstantAnswers) {
  const fuzz::MotionCase globe{fuzz::globe(2, 0.3, 1), {0, 0, 0}, {20, 1e-10, false}};
  const auto triangles = globe.mesh.triangles.size();
  ASSERT_TRUE(reference::violations(globe.mesh, globe.thresholds, exact::exact_viewpoint({0, 0, 0})).empty());
  const auto none = judged(globe, std::vector<double>(triangles, 0));
  EXPECT_EQ(none.proved, triangles);
  const auto all = judged(globe, std::vector<double>(triangles, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(all.refuted, triangles);
  const auto ten = judged(globe, std::vector<double>(triangles, 10));
  EXPECT_EQ(ten.refuted, triangles);
}

// Planted: a facing test with a tolerance, which takes a triangle that is nearly edge-on for one that has still some way to go.
TEST(JudgeOfBounds, RefutesAFacingTestWithEpsilon) {
  fuzz::MotionCase test{
      {{{{0, 0, 3}}, {{1, 0, 3}}, {{0, 1, 3}}}, {{0, 1, 2}}}, {0.25, 0.25, 3 - 0x1p-40}, {1e6, 0, false}};
  EXPECT_EQ(judged(test, {0x1p-40}).proved, 1);
  EXPECT_EQ(judged(test, {1e-9}).refuted, 1);
  test.viewpoint[2] = 3;
  EXPECT_EQ(judged(test, {5e-324}).refuted, 1);
  test.viewpoint[2] = 3 + 0x1p-51;
  EXPECT_EQ(judged(test, {5e-324}).refuted, 1);
}

// Coordinates and claims at the ends of what doubles can hold: squares overflow, or are 0.
TEST(JudgeOfBounds, HugeAndTinyNumbers) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double size : {1e300, 1e-300}) {
    const fuzz::MotionCase test{
        {{{{0, 0, 3 * size}}, {{size, 0, 3 * size}}, {{0, size, 3 * size}}, {{2 * size, 2 * size, 3 * size}}},
         {{0, 1, 2}, {3, 2, 1}}},
        {0, 0, 0},
        {2000, 1e-9, true}};
    const auto bounds = reference_bounds(test);
    EXPECT_GT(bounds[0], 0);
    EXPECT_EQ(judged(test, bounds).refuted, 0);
    for (const double claim : {4 * size, 1.7e308, infinite})
      EXPECT_EQ(judged(test, {claim, claim}).refuted, 2) << claim;
    EXPECT_EQ(judged(test, {5e-324, 0}).refuted, 0);
  }
}

// Units that are a power of two change nothing but the units, up to where 256 times a claim is more than a double can hold, and down to the least.
TEST(JudgeOfBounds, WhatIsProvedOfAnUndecidedClaimScales) {
  const auto undecided = [](int exponent) {
    const double s = std::ldexp(1.0, exponent);
    const fuzz::MotionCase test{
        {{{{0, 0, 3 * s}}, {{s, 0, 3 * s}}, {{0, s, 3 * s}}}, {{0, 1, 2}}}, {0, 0, 0}, {2000, 0x1p-10, false}};
    return judged(test, {2.875 * s}, 1).triangles[0];
  };
  const auto one = undecided(0);
  ASSERT_EQ(one.verdict, BoundVerdict::undecided);
  ASSERT_GT(one.proved, 0);
  for (const int exponent : {-1000, -500, 500, 1000, 1021}) {
    const auto other = undecided(exponent);
    EXPECT_EQ(other.verdict, BoundVerdict::undecided) << exponent;
    EXPECT_EQ(other.proved, std::ldexp(one.proved, exponent)) << exponent;
  }
}

TEST(JudgeOfBounds, DoesNotDependOnThreads) {
  const fuzz::MotionCase globe{fuzz::globe(2, 0.5, 2), {0.1, 0, 0}, {20, 1e-10, true}};
  auto claims = reference_bounds(globe);
  for (std::size_t i = 0; i < claims.size(); i += 3) claims[i] *= 3;
  validate::JudgeBoundsOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const auto first = validate::judge_motion_bounds(globe.mesh, globe.thresholds, globe.viewpoint, claims, one);
  const auto second = validate::judge_motion_bounds(globe.mesh, globe.thresholds, globe.viewpoint, claims, two);
  EXPECT_EQ(validate::to_json_text(first, globe.mesh), validate::to_json_text(second, globe.mesh));
  EXPECT_GT(first.refuted, 0);
  EXPECT_GT(first.proved, claims.size() / 2);
}

TEST(JudgeOfBounds, RefusesWhatIsNoList) {
  const auto test = fuzz::motion_case(fuzz::MotionKind::random, 35, 0);
  EXPECT_THROW(judged(test, {1}), scene::Error);
  EXPECT_THROW(judged(test, {1, -1}), scene::Error);
  EXPECT_THROW(judged(test, {1, std::nan("")}), scene::Error);
}

// The Delaunay property of an edge fails at the viewpoint. One triangle more at this edge, or the other way round, and nothing is across it: then no
// bound may be called sound.
TEST(JudgeOfBounds, RefusesDelaunayWhereNothingSaysWhatIsAcross) {
  fuzz::MotionCase test{{{{{1, 0, 3}}, {{0, 1, 3}}, {{-1, 0, 3}}, {{0, -0.2, 3}}}, {{0, 1, 2}, {0, 2, 3}}},
                        {0, 0, 0},
                        {2000, 4e-14, true}};
  EXPECT_EQ(judged(test, {0.5, 0.5}).refuted, 2);
  const auto message = [](const auto& ask) -> std::string {
    try {
      ask();
    } catch (const scene::Error& e) {
      EXPECT_EQ(e.code(), scene::ErrorCode::bad_argument);
      return e.what();
    }
    return "";
  };
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  for (const auto& [triangles, names] : {std::pair(Triangles{{0, 1, 2}, {0, 2, 3}, {0, 2, 3}}, "triangles 0, 1, 2"),
                                         {Triangles{{0, 1, 2}, {2, 0, 3}}, "triangles 0, 1"}}) {
    test.mesh.triangles = triangles;
    test.thresholds.delaunay = true;
    const std::vector<double> none(triangles.size(), 0);
    const auto of_judge = message([&] { judged(test, none); });
    const auto of_bounds = message([&] { reference_bounds(test); });
    const auto of_violations =
        message([&] { reference::violations(test.mesh, test.thresholds, exact::exact_viewpoint(test.viewpoint)); });
    EXPECT_NE(of_judge.find("the edge 0-2"), std::string::npos) << of_judge;
    EXPECT_NE(of_judge.find(names), std::string::npos) << of_judge;
    EXPECT_EQ(of_bounds, of_violations);
    EXPECT_TRUE(of_bounds.find("the edge 0-2") != std::string::npos ||
                of_bounds.find("the edge 2-0") != std::string::npos)
        << of_bounds;
    EXPECT_NE(of_bounds.find(names), std::string::npos) << of_bounds;
    test.thresholds.delaunay = false;
    EXPECT_EQ(judged(test, none).proved, triangles.size());
    EXPECT_EQ(reference_bounds(test).size(), triangles.size());
  }
}

// A needle of 1e100, seen from 1 beside it: what is left of its end across it is 1e-100 of the whole, and nothing when it is squared.
TEST(JudgeOfBounds, AViewpointNextToALineThatIsLong) {
  fuzz::MotionCase test{{{{{1, 0, -1e100}}, {{1, 0, 0}}, {{1, -5, -3}}}, {{0, 1, 2}}}, {0, 0, 0}, {2000, 0, false}};
  EXPECT_EQ(judged(test, {0.99999999}).refuted, 1);
}

// Ends 1e-200 apart, seen from 1 away, are one point in 512 digits.
TEST(JudgeOfBounds, AnEdgeThatIsShortForItsDistance) {
  fuzz::MotionCase test{{{{{0, 0, 0}}, {{1e-200, 0, 0}}, {{0, 1, -1}}}, {{1, 0, 2}}}, {-1, 1, 1}, {2.3e200, 0, false}};
  EXPECT_EQ(judged(test, {0.5}).refuted, 1);
}

// A ball that holds a violation is never proved.
TEST(BallProof, NeverProvesWhatIsFalse) {
  int proved = 0, refuted = 0;
  for (std::uint64_t n = 0; n < 150; ++n) {
    const auto test = fuzz::motion_case(static_cast<fuzz::MotionKind>(n % fuzz::motion_kinds), 36, n);
    const auto& s = test.mesh.samples;
    const exact::ExactThresholds thresholds(test.thresholds);
    const auto v = exact::exact_viewpoint(test.viewpoint);
    const double facing = reference::facing_bound(s[0], s[1], s[2], v);
    for (const double factor : {0.01, 0.1, 0.5, 1.5}) {
      const double radius = std::min(facing, 1e9) * factor;
      for (const bool delaunay : {false, true}) {
        validate::BallClaim claim{
            scene::MotionConstraint::separation, {&s[2], s.data(), &s[1]}, test.viewpoint, test.thresholds.sigma};
        if (delaunay) {
          claim.constraint = scene::MotionConstraint::delaunay;
          claim.samples = {s.data(), &s[1], &s[2], &s[3]};
        }
        if (!validate::prove_in_ball(claim, radius, 300).proved) {
          ++refuted;
          continue;
        }
        ++proved;
        for (int corner = 0; corner < 27; ++corner) {
          const int digits[] = {corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1};
          auto at = v;
          for (std::size_t i = 0; i < 3; ++i) at[i] += mpq_class(digits[i] * 0.57 * radius);
          ASSERT_TRUE(validate::holds_at(claim.constraint, claim.samples, at, thresholds)) << n << " " << factor;
        }
      }
    }
  }
  EXPECT_GT(proved, 200);
  EXPECT_GT(refuted, 150);
}

}  // namespace
}  // namespace clues
