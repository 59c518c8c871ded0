// D19: the judge on a scene whose answers are known, and tests of the test: implementations that are wrong on purpose must
// get the right bad verdict.
#include "validate/verdicts/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "exact/sight/witness.h"
#include "fuzz/generators/random_scenes.h"
#include "validate/verdicts/judge_report.h"
#include "validate/verdicts/measures.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using exact::Point3;

// Triangles 0, 1: a wall. 2: a screen before it. 3: small, right behind the screen. 4: beside the screen.
scene::TriangleMesh screen_scene() {
  scene::TriangleMesh mesh;
  mesh.points = {{-20, -20, 4},    {20, -20, 4},    {20, 20, 4},   {-20, 20, 4}, {-6, -4, 2}, {6, -4, 2}, {0, 8, 2},
                 {-.5, -.5, 2.25}, {.5, -.5, 2.25}, {0, .5, 2.25}, {9, 0, 2},    {10, 0, 2},  {9, 1, 2}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}, {7, 9, 8}, {10, 12, 11}};
  mesh.face_of = {0, 1, 2, 3, 4};
  return mesh;
}

const std::vector<scene::Point> screen_cell{{-.25, -.25, -.25}, {.25, -.25, -.25}, {-.25, .25, -.25}, {.25, .25, -.25},
                                            {-.25, -.25, 0},    {.25, -.25, 0},    {-.25, .25, 0},    {.25, .25, 0}};

struct Judged {
  scene::TriangleMesh mesh = screen_scene();
  ConvexCell cell = ConvexCell::from_doubles(screen_cell);
  reference::VisibilityMap map = reference::first_order_visibility(mesh, cell, {});
  Judgement with(const std::vector<std::uint32_t>& pvs) const { return judge_pvs(mesh, map, pvs); }
};

TEST(Judge, ExactPvsIsSoundAndTight) {
  const auto judgement = Judged{}.with({0, 1, 2, 4});
  EXPECT_EQ(judgement.verdict, Verdict::sound);
  EXPECT_EQ(judgement.exact, 4U);
  EXPECT_EQ(judgement.loose + judgement.first_order, 0U);
}

TEST(Judge, HiddenTriangleListedIsLooseButSound) {
  const auto judgement = Judged{}.with({0, 1, 2, 3, 4});
  EXPECT_EQ(judgement.verdict, Verdict::sound);
  EXPECT_EQ(judgement.triangles[3], TriangleVerdict::loose);
  const Weights areas = area_weights(judgement, screen_scene());
  EXPECT_EQ(areas.hidden_listed, .5);
  EXPECT_EQ(areas.visible_listed, 1600 + 72 + .5);
  EXPECT_EQ(over_estimate(count_weights(judgement))->at_least, .25);
  EXPECT_EQ(over_estimate(areas)->at_most, .5 / 1672.5);
  EXPECT_EQ(under_estimate(areas)->at_most, 0);
}

TEST(Judge, TheUndecidedWidenTheBounds) {
  const Weights w{8, 2, 3, 1, 5};
  EXPECT_EQ(over_estimate(w)->at_least, 5.0 / 14);
  EXPECT_EQ(over_estimate(w)->at_most, 8.0 / 10);
  EXPECT_EQ(under_estimate(w)->at_least, 2.0 / 13);
  EXPECT_EQ(under_estimate(w)->at_most, 3.0 / 11);
  EXPECT_FALSE(over_estimate({0, 0, 3, 1, 5}).has_value());
}

TEST(Judge, FractionsOfTheFirstOrderMapAreExact) {
  // The screen hides part of the wall; what it leaves of the two triangles is rational, and the two sides of the screen are all or nothing.
  const Judged judged;
  const auto f = first_order_fractions(judged.mesh, judged.map);
  for (const std::size_t t : {0U, 1U}) {
    EXPECT_TRUE(f[t][0] > 0 && f[t][0] < 1) << f[t][0];
    EXPECT_EQ(f[t][1], 0);
  }
  EXPECT_EQ(f[2][0] + f[2][1], 1);
  EXPECT_EQ(f[3][0] + f[3][1], 0);
}

TEST(Judge, EveryVisibleTriangleIsMissedWithAConfirmedWitness) {
  const Judged judged;
  for (const std::uint32_t missing : {0U, 1U, 2U, 4U}) {
    std::vector<std::uint32_t> pvs{0, 1, 2, 4};
    std::erase(pvs, missing);
    const auto judgement = judged.with(pvs);
    EXPECT_EQ(judgement.verdict, Verdict::unsound);
    EXPECT_EQ(judgement.triangles[missing], TriangleVerdict::missing_visible);
    const auto witness = std::find_if(judgement.witnesses.begin(), judgement.witnesses.end(),
                                      [&](const Witness& w) { return w.triangle == missing; });
    ASSERT_NE(witness, judgement.witnesses.end());
    EXPECT_TRUE(exact::check_witness(judged.mesh, judged.cell, missing, witness->front, witness->v, witness->p).valid);
    EXPECT_THAT(to_text(judgement, {}), testing::HasSubstr("verdict: unsound"));
  }
}

TEST(Judge, EverythingHiddenIsUnsoundAndEverythingVisibleIsLoose) {
  const Judged judged;
  EXPECT_EQ(judged.with({}).verdict, Verdict::unsound);
  EXPECT_EQ(judged.with({}).missing_visible, 4U);
  EXPECT_EQ(judged.with({0, 1, 2, 3, 4}).loose, 1U);
}

// A map that is wrong on purpose: a visible triangle relabelled as hidden. The judge must notice, not believe.
TEST(Judge, WrongMapIsAContradiction) {
  Judged judged;
  std::erase(judged.map.visible, 4U);
  for (auto& region : judged.map.regions) {
    if (judged.map.complex.pieces[region.piece].origins.front().triangle == 4) region.visible = false;
  }
  const auto judgement = judged.with({0, 1, 2});
  EXPECT_EQ(judgement.verdict, Verdict::unsound);
  ASSERT_EQ(judgement.contradictions.size(), 1U);
  EXPECT_EQ(judgement.contradictions[0].triangle, 4U);
}

// A map that says "visible" where nothing is: no witness is found, and that is not called sound.
TEST(Judge, NoWitnessIsUndecided) {
  Judged judged;
  judged.map.visible = {0, 1, 2, 3, 4};
  for (auto& region : judged.map.regions) {
    if (judged.map.complex.pieces[region.piece].origins.front().triangle == 3) region.visible = true;
  }
  EXPECT_EQ(judged.with({0, 1, 2, 4}).verdict, Verdict::undecided);
  EXPECT_EQ(judged.with({0, 1, 2, 3, 4}).triangles[3], TriangleVerdict::first_order);
}

TEST(Judge, RandomScenesAgreeWithTheReference) {
  std::uint64_t visible = 0, hidden = 0;
  for (const auto kind : fuzz::all_kinds) {
    const auto generated = fuzz::generate(kind, 7, 0);
    const auto cell = ConvexCell::from_doubles(generated.cell);
    const auto map = reference::first_order_visibility(generated.mesh, cell, {});
    const auto own = judge_pvs(generated.mesh, map, map.visible);
    EXPECT_EQ(own.verdict, Verdict::sound) << generated.name;
    EXPECT_TRUE(own.contradictions.empty()) << generated.name;
    visible += own.exact;
    hidden +=
        static_cast<std::uint64_t>(std::count(own.triangles.begin(), own.triangles.end(), TriangleVerdict::hidden));
  }
  EXPECT_GT(visible, 0U);
  EXPECT_GT(hidden, 0U);
}

}  // namespace
}  // namespace clues::validate
