// D1, D4: what a suite may not say of a triangle, whatever its author proves by it.
#include <gtest/gtest.h>

#include "exact/sight/scene_query.h"
#include "validate/conform/grade.h"

namespace clues::validate {
namespace {

VectorCase one_triangle(const std::array<scene::Point, 3>& corners, std::vector<scene::Point> cell, CaseMode mode) {
  VectorCase test;
  test.mesh.points.assign(corners.begin(), corners.end());
  test.mesh.triangles = {{0, 1, 2}};
  test.mesh.face_of = {0};
  test.cell = std::move(cell);
  test.mode = mode;
  return test;
}

MustBeVisible meets_cell() {
  MustBeVisible proof;
  proof.meets_cell = true;
  return proof;
}

// It was said to be visible, and does not even touch the cell.
TEST(FlawOfProof, ATriangleWithoutAreaIsNoSurface) {
  const auto apart = one_triangle({{{-3, .5, .5}, {.5, .5, .5}, {3, .5, .5}}}, {{.25, .75, .5}}, CaseMode::sheet);
  EXPECT_NE(flaw_of_proof(apart, meets_cell()), "");
  const std::vector<scene::Point> box{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto within = one_triangle({{{-3, .25, .25}, {.25, .25, .25}, {3, .25, .25}}}, box, CaseMode::sheet);
  EXPECT_NE(flaw_of_proof(within, meets_cell()), "");
  const auto surface = one_triangle({{{-3, .25, .25}, {.25, .25, .25}, {3, .25, 2}}}, box, CaseMode::sheet);
  EXPECT_EQ(flaw_of_proof(surface, meets_cell()), "");
}

TEST(FlawOfProof, ABackSideDoesNotCountInSolidMode) {
  const std::array<scene::Point, 3> corners{{{-4, -4, 2}, {4, -4, 2}, {0, 4, 2}}};  // its back faces the cell
  MustBeVisible proof;
  proof.front = false;
  proof.v = {"0", "0", "0"};
  proof.p = {"0", "0", "2"};
  EXPECT_EQ(flaw_of_proof(one_triangle(corners, {{0, 0, 0}}, CaseMode::sheet), proof), "");
  EXPECT_NE(flaw_of_proof(one_triangle(corners, {{0, 0, 0}}, CaseMode::solid), proof), "");
}

TEST(MeetsCell, NothingWithoutAreaDoes) {
  const auto cell = exact::ConvexCell::from_doubles({{.25, .75, .5}});
  EXPECT_FALSE(
      exact::meets_cell({exact::Point3(-3, .5, .5), exact::Point3(.5, .5, .5), exact::Point3(3, .5, .5)}, cell));
}

}  // namespace
}  // namespace clues::validate
