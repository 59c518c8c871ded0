// Coverage of the method: rules are counted where a map shows them, and what never met is named.
#include "fuzz/oracles/rules.h"

#include <gmock/gmock.h>

#include "exact/cell/convex_cell.h"

namespace clues::fuzz {
namespace {

Counters rules_of(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell) {
  Case scene;
  scene.mesh = mesh;
  scene.cell = cell;
  Counters counters;
  count_rules(scene, reference::first_order_visibility(mesh, exact::ConvexCell::from_doubles(cell), {}), counters);
  return counters;
}

TEST(Rules, AreCountedWhereAMapShowsThem) {
  // A small triangle before a large one, seen from a point: no wedge but SV-ME, and a border.
  scene::TriangleMesh mesh;
  mesh.points = {{-8, -8, 2}, {8, -8, 2}, {0, 8, 2}, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.face_of = {0, 1};
  auto met = rules_of(mesh, {{0, 0, 0}});
  EXPECT_EQ(met["rule D2 point"], 1U);
  EXPECT_EQ(met["rule D10 SV-ME"], 1U);
  EXPECT_EQ(met["rule D15 border on a surface"], 1U);
  EXPECT_EQ(met["pair D2 point + D10 SV-ME"], 1U);
  EXPECT_EQ(met.count("rule D16 triangle cut by another"), 0U);
  // A third one through both.
  mesh.points.insert(mesh.points.end(), {{0, 0, 0.5}, {0.25, 0, 3}, {0.25, 0.5, 3}});
  mesh.triangles.push_back({6, 7, 8});
  mesh.face_of.push_back(2);
  met = rules_of(mesh, {{-0.1, -0.1, -1}, {0.1, -0.1, -1}, {0, 0.1, -1}, {0, 0, -0.5}});
  EXPECT_EQ(met["rule D2 solid cell"], 1U);
  EXPECT_EQ(met["rule D16 triangle cut by another"], 1U);
}

TEST(Rules, WhatNeverMetIsNamed) {
  const auto nothing = rules_met({});
  EXPECT_EQ(nothing.pairs, 0U);
  EXPECT_TRUE(nothing.apart.empty());
  const auto all = nothing.never.size();
  EXPECT_EQ(nothing.impossible, 6U + 3U + 7U) << "kinds of cells; what is in the cell; edges of a point";
  EXPECT_EQ(nothing.all_pairs, all * (all - 1) / 2 - nothing.impossible);
  const auto some = rules_met({{"rule D2 point", 3},
                               {"rule D2 segment", 2},
                               {"rule D10 SV-ME", 4},
                               {"rule D14 walk", 1},
                               {"pair D2 point + D10 SV-ME", 2},
                               {"pair D10 SV-ME + D14 walk", 1}});
  EXPECT_EQ(some.pairs, 2U);
  EXPECT_EQ(some.never.size(), all - 4);
  EXPECT_THAT(some.apart,
              testing::ElementsAre("D2 point + D14 walk", "D2 segment + D10 SV-ME", "D2 segment + D14 walk"));
}

// What is said to be impossible is looked for all the same.
TEST(Rules, ImpossiblePairsThatMeetAreNamed) {
  const auto met = rules_met({{"rule D2 point", 1}, {"rule D11 SE-ME", 1}, {"pair D2 point + D11 SE-ME", 1}});
  EXPECT_THAT(met.wrongly_impossible,
              testing::ElementsAre(testing::StartsWith("D2 point + D11 SE-ME, though a plane")));
  EXPECT_TRUE(met.apart.empty());
  EXPECT_EQ(met.pairs, 0U);
}

}  // namespace
}  // namespace clues::fuzz
