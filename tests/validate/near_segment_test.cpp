// The witness checker says the same of the triangles near a segment as of all.
#include "validate/cells/near_segment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact/sight/witness.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "tests/seed.h"

namespace clues::tests {
namespace {

TEST(NearSegment, TheWitnessCheckerAnswersAsInTheWholeScene) {
  fuzz::Random random(kSeed);
  std::uint64_t valid = 0, blocked = 0, left_out = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    const auto scene = fuzz::generate(fuzz::all_kinds[index % fuzz::all_kinds.size()], kSeed, index);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    const auto& mesh = scene.mesh;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      // From the middle of the cell to a point of the triangle, which often is one of a grid: lines that touch are usual.
      const exact::Point3 v = cell.center();
      const auto corner = [&](std::size_t i) { return exact::to_exact(mesh.points[mesh.triangles[t][i]]); };
      const int a = random.between(1, 4), b = random.between(1, 4), c = random.between(1, 4);
      const exact::Point3 p =
          CGAL::barycenter(corner(0), exact::FT(a), corner(1), exact::FT(b), corner(2), exact::FT(c));
      const auto near = validate::near_segment(mesh, t, v, p);
      ASSERT_EQ(near.mesh.triangles[near.triangle], mesh.triangles[t]);
      left_out += mesh.triangles.size() - near.mesh.triangles.size();
      for (const bool front : {true, false}) {
        const auto all = exact::check_witness(mesh, cell, t, front, v, p);
        const auto few = exact::check_witness(near.mesh, cell, near.triangle, front, v, p);
        ASSERT_EQ(few.valid, all.valid) << scene.name << " triangle " << t;
        ASSERT_EQ(few.special, all.special) << scene.name << " triangle " << t;
        valid += all.valid ? 1 : 0;
        blocked += all.reason.find("blocks") != std::string::npos ? 1 : 0;
      }
    }
  }
  EXPECT_GT(valid, 100U);
  EXPECT_GT(blocked, 100U);
  EXPECT_GT(left_out, 1000U);
}

// The segment is parallel to an axis, so that its box has no width, and a blocker only touches it.
TEST(NearSegment, WhatOnlyTouchesItsBoxIsNear) {
  const auto cell = exact::ConvexCell::from_doubles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
  const exact::Point3 v(0.5, 0.5, 0.5), p(10, 0.5, 0.5);
  for (const double side : {-1.0, 1.0}) {
    scene::TriangleMesh mesh;
    mesh.points = {{10, -9, -9},  {10, 9, -9},          {10, 0, 9},
                   {5, 0.5, 0.5}, {5, 0.5 + side, 0.5}, {6, 0.5 + side, 0.5 + side}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.face_of = {0, 1};
    for (const bool front : {true, false}) {
      const auto near = validate::near_segment(mesh, 0, v, p);
      ASSERT_EQ(near.mesh.triangles.size(), 2U);
      EXPECT_FALSE(exact::check_witness(near.mesh, cell, near.triangle, front, v, p).valid);
    }
    mesh.points[3][1] += side * 0x1p-50;
    EXPECT_EQ(validate::near_segment(mesh, 0, v, p).mesh.triangles.size(), 1U);
  }
}

// A line along the diagonal of its box: what lies elsewhere in the box is left out, what touches the line in a corner is not.
TEST(NearSegment, WhatADiagonalLinePassesByIsNotNear) {
  const exact::Point3 v(0, 0, 0), p(8, 8, 8);
  for (const int far : {0, 1, 2}) {
    for (const double side : {1.0, 7.0}) {
      scene::TriangleMesh mesh;
      const auto at = [&](double x, double y, double z) {
        scene::Point q{x, y, z};
        std::rotate(q.begin(), q.begin() + far, q.end());
        mesh.points.push_back(q);
      };
      at(8, 0, 9), at(8, 9, 9), at(8, 9, 0);  // the one that is asked
      at(side, 4, 4), at(side, 5, 4), at(side, 4, 5);
      at(3, 3, 3), at(2, 3, 4), at(2, 4, 4);
      mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
      mesh.face_of = {0, 1, 2};
      const auto near = validate::near_segment(mesh, 0, v, p);
      ASSERT_EQ(near.mesh.triangles.size(), 2U);
      EXPECT_EQ(near.mesh.triangles[1], mesh.triangles[2]) << "it touches the line in a corner";
    }
  }
}

}  // namespace
}  // namespace clues::tests
