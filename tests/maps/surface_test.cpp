// What is a surface (D31), and what is refused, with the place.
#include "reference/multires/stars/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fuzz/multires/surfaces.h"
#include "scene/messages/error.h"
#include "validate/multires/level_topology.h"

namespace clues {
namespace {

using testing::HasSubstr;

scene::TriangleMesh mesh_of(std::size_t points, std::vector<scene::Triangle> triangles) {
  scene::TriangleMesh mesh;
  for (std::size_t k = 0; k < points; ++k) mesh.points.push_back({double(k), double(k * k), double(k % 3)});
  mesh.triangles = std::move(triangles);
  return mesh;
}

std::string refusal(const scene::TriangleMesh& mesh) {
  try {
    reference::checked_surface(mesh, "m.off");
  } catch (const scene::Error& error) {
    EXPECT_EQ(error.code(), scene::ErrorCode::unsupported);
    return error.what();
  }
  return "";
}

TEST(Surface, KnowsGenusAndBoundaries) {
  for (int holes = 0; holes < 4; ++holes) {
    const auto census = reference::checked_surface(fuzz::frame(holes, 2), "frame");
    EXPECT_EQ(census.genus(), holes);
    EXPECT_EQ(census.boundaries, 0U);
    EXPECT_EQ(census.components, 1U);
  }
  EXPECT_EQ(reference::checked_surface(fuzz::sheet(4), "sheet").boundaries, 1U);
  EXPECT_EQ(reference::checked_surface(fuzz::fan(5, true), "fan").euler(), 1);
}

TEST(Surface, RefusesWithThePlace) {
  EXPECT_THAT(refusal(mesh_of(0, {})), HasSubstr("no triangles"));
  EXPECT_THAT(refusal(mesh_of(4, {{0, 1, 2}, {0, 2, 2}})), HasSubstr("triangle 1: vertex 2"));
  EXPECT_THAT(refusal(mesh_of(3, {{0, 1, 2}, {2, 0, 1}})), HasSubstr("triangles 0 and 1 have the same three"));
  EXPECT_THAT(refusal(mesh_of(3, {{0, 1, 2}, {2, 1, 0}})), HasSubstr("triangles 0 and 1 have the same three"));
  EXPECT_THAT(refusal(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})),
              HasSubstr("from vertex 0 to vertex 1 belongs to 3 triangles (0, 1, 2)"));
  EXPECT_THAT(refusal(mesh_of(4, {{0, 1, 2}, {0, 1, 3}})), HasSubstr("orient the triangles alike"));
  EXPECT_THAT(refusal(mesh_of(4, {{0, 1, 2}})), HasSubstr("vertex 3 belongs to no triangle"));
  EXPECT_THAT(refusal(mesh_of(5, {{0, 1, 2}, {0, 3, 4}})), HasSubstr("vertex 0: several fans"));
  EXPECT_THAT(refusal(fuzz::moebius(5)), HasSubstr("one side only"));
  EXPECT_EQ(refusal(mesh_of(3, {{0, 1, 2}})), "");
}

// Two ways to one answer: OpenMesh takes what we take.
TEST(Surface, AgreesWithHalfEdges) {
  for (std::uint64_t k = 0; k < 200; ++k) {
    auto test = fuzz::surface_case(11, k);
    const auto census = reference::checked_surface(test.mesh, "case");
    EXPECT_EQ(census.genus(), test.genus) << k;
    EXPECT_EQ(census.boundaries, static_cast<std::uint64_t>(test.boundaries)) << k;
    const auto halves = validate::topology_of(test.mesh.triangles, test.mesh.points.size());
    EXPECT_EQ(halves.defect, "") << k;
    EXPECT_EQ(halves.euler(), census.euler()) << k;
    EXPECT_EQ(static_cast<std::uint64_t>(halves.boundaries), census.boundaries) << k;
    // One triangle turned round, or glued somewhere else.
    std::swap(test.mesh.triangles[k % test.mesh.triangles.size()][0],
              test.mesh.triangles[k % test.mesh.triangles.size()][1]);
    if (test.mesh.triangles.size() > 1) {
      EXPECT_NE(refusal(test.mesh), "") << k;
      EXPECT_NE(validate::topology_of(test.mesh.triangles, test.mesh.points.size()).defect, "") << k;
    }
  }
}

}  // namespace
}  // namespace clues
