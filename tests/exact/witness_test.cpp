// D5, D6: what the witness checker accepts and what it must refuse.
#include "exact/sight/witness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact/sight/point_occlusion.h"
#include "fuzz/generators/random_scenes.h"

namespace clues::exact {
namespace {

// Triangle 0 faces the cell [-2,-1] x [-1,1]^2 from x = 1; its front is the low-x side.
class Witness : public ::testing::Test {
 protected:
  Witness() : cell_(ConvexCell::from_doubles(corners())) { add({1, -1, -1}, {1, 0, 2}, {1, 2, -1}); }

  static std::vector<scene::Point> corners() {
    std::vector<scene::Point> points;
    for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? -1.0 : -2.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    return points;
  }
  void add(const scene::Point& a, const scene::Point& b, const scene::Point& c) {
    const auto n = static_cast<std::uint32_t>(mesh_.points.size());
    mesh_.points.insert(mesh_.points.end(), {a, b, c});
    mesh_.triangles.push_back({n, n + 1, n + 2});
    mesh_.face_of.push_back(n / 3);
  }
  WitnessVerdict check(const Point3& v, const Point3& p, bool front = true) const {
    return check_witness(mesh_, cell_, 0, front, v, p);
  }
  static bool names(const WitnessVerdict& verdict, const std::string& text) {
    return !verdict.valid && verdict.reason.find(text) != std::string::npos;
  }

  ConvexCell cell_;
  scene::TriangleMesh mesh_;
  const Point3 v_{FT(-3) / 2, 0, 0}, p_{1, 0, 0};
};

TEST_F(Witness, AFreeLineIsAccepted) {
  const auto verdict = check(v_, p_);
  EXPECT_TRUE(verdict.valid) << verdict.reason;
  EXPECT_TRUE(verdict.reason.empty());
}

TEST_F(Witness, EveryConditionIsChecked) {
  EXPECT_TRUE(names(check(v_, p_, false), "back side"));
  EXPECT_TRUE(names(check(v_, Point3(1, 0, -1)), "relative interior of triangle"));                  // on its edge
  EXPECT_TRUE(names(check(v_, Point3(FT(1) + FT(1) / FT(1000000007), 0, 0)), "relative interior"));  // off its plane
  EXPECT_TRUE(names(check(v_, Point3(1, 3, 0)), "relative interior of triangle"));
  EXPECT_TRUE(names(check(Point3(-1, 0, 0), p_), "interior of the cell"));
  EXPECT_TRUE(names(check(Point3(0, 0, 0), p_), "interior of the cell"));
  EXPECT_TRUE(names(check_witness(mesh_, cell_, 7, true, v_, p_), "no triangle 7"));
  mesh_.triangles[0][2] = mesh_.triangles[0][1];
  EXPECT_TRUE(names(check(v_, p_), "no area"));
}

TEST_F(Witness, ABlockerIsNamed) {
  add({0, 5, 5}, {0, 6, 5}, {0, 5, 6});
  EXPECT_TRUE(check(v_, p_).valid);
  add({0, -1, -1}, {0, 1, -1}, {0, 0, 1});
  EXPECT_TRUE(names(check(v_, p_), "triangle 2 blocks"));
}

TEST_F(Witness, GrazingBlocks) {
  add({0, 0, 0}, {0, 1, 0}, {0, 0, 1});  // corner
  EXPECT_TRUE(names(check(v_, p_), "triangle 1 blocks"));
  EXPECT_TRUE(check(v_, Point3(1, FT(-1) / FT(1000000000), 0)).valid);
  mesh_.triangles.pop_back();
  add({0, -1, 0}, {0, 1, 0}, {0, 0, 1});  // edge
  EXPECT_FALSE(check(v_, p_).valid);
  mesh_.triangles.pop_back();
  add({-0.5, 0, 0}, {0.5, 0, 0}, {0, 0, 1});  // an edge along the line, in a plane with it
  EXPECT_FALSE(check(v_, p_).valid);
  mesh_.triangles.pop_back();
  add({-0.5, 0, 0.25}, {0.5, 0, 0.25}, {0, 0, 1});  // in a plane with the line, apart
  EXPECT_TRUE(check(v_, p_).valid);
  mesh_.triangles.pop_back();
  add({0, 0, 0}, {0.5, 0, 0}, {0.25, 0, 0});  // no area: no surface
  EXPECT_TRUE(check(v_, p_).valid);
}

TEST_F(Witness, OnlyWhatLiesBetweenIntVAndPBlocks) {
  add({1.5, -1, -1}, {1.5, 1, -1}, {1.5, 0, 1});        // behind p
  add({-3, -1, -1}, {-3, 1, -1}, {-3, 0, 1});           // behind the cell
  add({-1.25, -1, -1}, {-1.25, 1, -1}, {-1.25, 0, 1});  // inside the cell, in front of v (D3)
  add({-1.5, 0, 0}, {-1.125, 0, 0}, {-1.25, 0, 0.5});   // in a plane with the line, inside the cell
  EXPECT_TRUE(check(v_, p_).valid) << check(v_, p_).reason;
  add({-1, -1, -1}, {-1, 1, -1}, {-1, 0, 1});  // on the cell's surface: not int V
  EXPECT_TRUE(names(check(v_, p_), "triangle 5 blocks"));
}

// D6 with an area: nothing but p itself might be seen (docs/visible-set.md, section 5).
TEST_F(Witness, APointWhereAnotherTriangleTouchesIsNoWitness) {
  add({1, -1, 0}, {1, 1, 0}, {1, 0, 1});  // in the plane of the target: no matter
  EXPECT_TRUE(check(v_, p_).valid) << check(v_, p_).reason;
  add({1, 0, 0}, {1, 0, 1}, {3, 0, 0});
  EXPECT_TRUE(names(check(v_, p_), "triangle 2 touches triangle 0 at p"));
}

TEST_F(Witness, AnEdgeThatReachesPAlongTheLineBlocks) {
  add({1, 0, 0}, {0.5, 0, 0}, {1, 0, 1});
  EXPECT_TRUE(names(check(v_, p_), "triangle 1 blocks"));
}

TEST_F(Witness, FlatCells) {
  const auto square = ConvexCell::from_doubles({{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}});
  const auto segment = ConvexCell::from_doubles({{-1, -1, 0}, {-1, 1, 0}});
  const auto end_on = ConvexCell::from_doubles({{-1, 0, 0}, {-2, 0, 0}});
  const auto point = ConvexCell::from_doubles({{-1, 0, 0}});
  const Point3 v(-1, 0, 0);
  for (const auto* cell : {&square, &segment, &point}) {
    EXPECT_TRUE(check_witness(mesh_, *cell, 0, true, v, p_).valid);
    EXPECT_FALSE(check_witness(mesh_, *cell, 0, true, Point3(-1, 1, 0), p_).valid);
    EXPECT_FALSE(check_witness(mesh_, *cell, 0, true, Point3(FT(-1) / 2, 0, 0), p_).valid);
  }
  add({-1, -1, -1}, {-1, 1, -1}, {-1, 0, 1});  // through v, which is int V of the flat cells
  for (const auto* cell : {&square, &segment, &point}) {
    EXPECT_TRUE(check_witness(mesh_, *cell, 0, true, v, p_).valid);
  }
  EXPECT_FALSE(check_witness(mesh_, end_on, 0, true, v_, p_).valid);  // there it is the cell's end
  mesh_.triangles.pop_back();
  EXPECT_TRUE(check_witness(mesh_, end_on, 0, true, v_, p_).valid);
}

// D6: an open part of int V. A triangle that holds v may stop all that is beside v.
TEST_F(Witness, AViewpointThatATriangleStandsOnIsNoWitness) {
  const auto square = ConvexCell::from_doubles({{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}});
  const auto segment = ConvexCell::from_doubles({{-1, -1, 0}, {-1, 1, 0}});
  const auto point = ConvexCell::from_doubles({{-1, 0, 0}});
  const auto solid = ConvexCell::from_doubles({{-2, -1, -1}, {0, -1, -1}, {-1, 1, -1}, {-1, 0, 1}});
  const Point3 v(-1, 0, 0);
  add({-1, 0, 0}, {-0.5, -2, 0}, {-1, -2, 0});  // stands on the segment, from v on
  add({-1, 0, 0}, {-0.5, 2, 0}, {-1, 2, 0});
  for (const auto* cell : {&square, &segment}) {
    const auto verdict = check_witness(mesh_, *cell, 0, true, v, p_);
    EXPECT_TRUE(names(verdict, "v lies on triangle 1: choose another viewpoint")) << verdict.reason;
    EXPECT_TRUE(verdict.special);
    EXPECT_EQ(check_sight_line(mesh_, *cell, v, p_).spoiler, std::optional<std::uint32_t>(1));
    EXPECT_TRUE(check_sight_line(mesh_, *cell, v, p_).blockers.empty());
  }
  EXPECT_TRUE(check_witness(mesh_, point, 0, true, v, p_).valid);
  EXPECT_TRUE(check_witness(mesh_, solid, 0, true, v, p_).valid);
  mesh_.triangles.resize(1);
  add({-1, -2, 0}, {-1, 2, 0}, {-3, 0, 0});  // along the segment, behind it
  EXPECT_TRUE(check_witness(mesh_, segment, 0, true, v, p_).valid);
  EXPECT_FALSE(check_witness(mesh_, square, 0, true, v, p_).valid);
}

// p in the plane of the cell: there triangles block that lie in int V.
TEST_F(Witness, SightLinesWithinThePlaneOfAFlatCell) {
  const auto square = ConvexCell::from_doubles({{-3, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {-3, 1, 0}});
  const Point3 v(-2, 0, 0);
  EXPECT_TRUE(check_witness(mesh_, square, 0, true, v, p_).valid);
  add({-2.5, -1, 0}, {-2.5, 1, 0}, {-2, 0, 0});  // v is its corner, and behind it is v of no use
  EXPECT_TRUE(names(check_witness(mesh_, square, 0, true, v, p_), "v lies on triangle 1"));
  EXPECT_TRUE(check_witness(mesh_, square, 0, true, v, Point3(1, 0, FT(1) / 2)).valid);
  add({-1.5, -1, -1}, {-1.5, 1, -1}, {-1.5, 0, 1});  // across the cell
  EXPECT_TRUE(names(check_witness(mesh_, square, 0, true, v, p_), "triangle 2 blocks"));
  EXPECT_TRUE(check_witness(mesh_, square, 0, true, Point3(FT(-5) / 4, 0, 0), p_).valid);
}

// Planted: every witness of the oracle passes; moved p, swapped side, and a blocker laid across are refused.
TEST_F(Witness, TheOraclesWitnessesPassAndDamagedOnesDoNot) {
  int confirmed = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t index = 0; index < 8; ++index) {
      auto scene = fuzz::generate(kind, 9, index);
      const auto cell = ConvexCell::from_doubles(scene.cell);
      std::vector<TriangleCorners> soup;
      const auto at = [&](std::uint32_t i) { return to_exact(scene.mesh.points[i]); };
      for (const auto& t : scene.mesh.triangles) soup.push_back({at(t[0]), at(t[1]), at(t[2])});
      for (std::uint32_t i = 0; i < soup.size(); i += 2) {
        const Point3 p = CGAL::centroid(soup[i][0], soup[i][1], soup[i][2]);
        const Plane3 front(soup[i][0], soup[i][1], soup[i][2]);
        for (const bool is_front : {true, false}) {
          const auto answer = point_occlusion(p, is_front ? front : front.opposite(), cell, soup);
          if (answer.occluded || !answer.witness) continue;
          const auto verdict = check_witness(scene.mesh, cell, i, is_front, *answer.witness, p);
          ASSERT_TRUE(verdict.valid) << scene.name << " triangle " << i << ": " << verdict.reason;
          EXPECT_FALSE(check_witness(scene.mesh, cell, i, !is_front, *answer.witness, p).valid);
          EXPECT_FALSE(check_witness(scene.mesh, cell, i, is_front, *answer.witness, soup[i][0]).valid);
          EXPECT_FALSE(check_witness(scene.mesh, cell, i, is_front, p, p).valid);
          ++confirmed;
        }
      }
    }
  }
  EXPECT_GT(confirmed, 100);
}

}  // namespace
}  // namespace clues::exact
