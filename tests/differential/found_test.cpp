// Scenes on which a kernel was wrong, gave up, or took minutes (found/): by hand, with the cells of points, segments and polygons and small whole coordinates.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scene/cell_spec.h"
#include "scene/mesh_io.h"
#include "tests/differential/scene_judge.h"

namespace clues::tests {
namespace {

fuzz::Case scene_of(const std::string& file, const std::string& cell) {
  const std::filesystem::path folder = std::filesystem::path(CLUES_TEST_DATA) / "found";
  fuzz::Case scene{file, 0, 0, {}, {}, false};
  scene.mesh = scene::read_mesh(folder / file);
  const bool is_file = cell.ends_with(".obj");
  scene.cell = scene::parse_cell(is_file ? (folder / cell).string() : cell).points;
  return scene;
}

// All three kernels list exactly these, without a fallback, and nothing that they call hidden is seen.
void expect_list(const std::string& file, const std::string& cell, const std::vector<std::uint32_t>& expected) {
  JudgeSettings settings;
  settings.visible_set = settings.no_fallbacks = true;
  settings.planted_bug = [&](KernelAnswer& a) {
    if (a.first_order) {
      EXPECT_EQ(a.visible, expected) << a.kernel;
    }
  };
  for (const Flaw& f : judge_scene(scene_of(file, cell), settings).flaws)
    ADD_FAILURE() << f.category << ' ' << f.detail;
}

// Triangle 6 was missing: the anti-cone of a vertex on the rim of a flat cell has two sides.
TEST(Found, AVertexOnTheRimOfAFlatCell) {
  expect_list("vertex-on-the-rim-of-a-flat-cell.obj", "box:2.5,2,-2,3.5,3,-2", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
}

TEST(Found, CurtainsThatStandOnAFlatCell) {
  expect_list("curtains-that-stand-on-a-flat-cell.off", "box:0,-1,0,1,1,0", {0, 1});
}

TEST(Found, TrianglesThatCrossInASegmentCell) {
  expect_list("triangles-that-cross-in-a-segment-cell.off", "box:0,0,0,1,0,0", {0, 1});
}

// "A direction cannot leave its arc."
TEST(Found, ASegmentCellInThePlaneOfATriangle) {
  expect_list("segment-cell-in-the-plane.obj", "box:-1,0,0,-1,0,1", {});
}

// "An edge piece without a walk in general position."
TEST(Found, AnEdgePieceThatAllSightLinesReachAlongAnEdge) {
  expect_list("edge-piece-without-a-walk.obj", "box:2,-1,-1,2,2,-1", {0, 1, 2});
}

// 72 s, 82 fallbacks.
TEST(Found, AnEdgeThatStartsInASegmentCell) {
  expect_list("edge-that-starts-in-a-segment-cell.obj", "box:1,-1,-4,1,-1,-2", {0, 1, 2, 3, 4});
}

// The reference listed triangle 4 as well, which is not in Omega.
TEST(Found, WallsOnTwoFacesOfTheCell) { expect_list("more-than-omega.obj", "box:0,1,-2,1,2,-1", {0, 1, 2, 3}); }

// The reference saw all of triangle 2.
TEST(Found, ATriangleInAPlaneWithAPointCell) {
  expect_list("triangle-in-a-plane-with-a-point-cell.obj", "box:-1,1,0,-1,1,0", {0, 1, 2});
}

// The fast path listed triangle 0.
TEST(Found, AWedgeInDoubtEndsAtASide) {
  expect_list("wedge-in-doubt-ends-at-a-side.obj", "wedge-in-doubt-ends-at-a-side.cell.obj", {1, 2});
}

// Walks of 64 legs; fallbacks in both kernels.
TEST(Found, ACornerOfThreeWalls) {
  expect_list("corner-of-three-walls.obj", "corner-of-three-walls.cell.obj", {0, 1, 2});
}

// The reference called most of a side hidden that is seen: it looked at a vertex from one place in V for each local face,
// but walls cut what V sees of one face into parts, and another part is the lit one.
TEST(Found, PartsOfAFaceAtAVertex) {
  expect_list("parts-of-a-face-at-a-vertex.obj", "parts-of-a-face-at-a-vertex.cell.obj", {0, 1, 2});
}

}  // namespace
}  // namespace clues::tests
