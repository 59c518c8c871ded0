// FIG. 21C with the repair of hazard A-1, and the mesh of the regions (FIG. 12).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "exact/sight/scene_query.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/hidden/render_states.h"
#include "reference/visibility/map/discontinuity_mesh.h"
#include "support.h"

namespace clues::test {
namespace {

using reference::RenderState;

// Joined over the visible regions of one side of a triangle: a label that all of them have.
RenderState state_of(const reference::VisibilityMap& map, std::uint32_t t, bool front) {
  const auto states = reference::render_states(map);
  RenderState all{true, true, true};
  bool any = false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& r = map.regions[i];
    if (!r.visible || r.front != front || map.complex.pieces[r.piece].origins.front().triangle != t) continue;
    any = true;
    all.no_z_compare &= states[i].no_z_compare;
    all.no_z_write &= states[i].no_z_write;
    all.no_backface_cull &= states[i].no_backface_cull;
  }
  EXPECT_TRUE(any);
  return all;
}

TEST(RenderStates, AWallBehindAPlate) {
  SceneBuilder s;
  s.plate(-2, -2, 2, 2, 1);
  s.plate(-10, -10, 10, 10, 2);
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -0.5, 1, 1, 0));
  const RenderState plate = state_of(map, 0, false), wall = state_of(map, 2, false);
  EXPECT_TRUE(plate.no_z_compare);  // nothing before it
  EXPECT_FALSE(plate.no_z_write);   // the wall is behind it
  EXPECT_TRUE(plate.no_backface_cull);
  EXPECT_FALSE(wall.no_z_compare);
  // Hazard A-1: nothing is behind the wall, so it need not write depth; but the plate may hide it, so it must be compared. The literal
  // text would draw it without either.
  EXPECT_TRUE(wall.no_z_write);
}

TEST(RenderStates, NeighboursInOneSurfaceDoNotMatter) {
  SceneBuilder s;
  s.plate(-2, -2, 2, 2, 1);
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -0.5, 1, 1, 0));
  for (const std::uint32_t t : {0U, 1U}) {
    const RenderState state = state_of(map, t, false);
    EXPECT_TRUE(state.no_z_compare && state.no_z_write && state.no_backface_cull);
  }
}

TEST(RenderStates, ACornerSeesItself) {
  // Two walls that face each other: each stands in the other's shaft.
  SceneBuilder s;
  s.quad({2, -1, 0}, {2, 1, 0}, {4, 1, 2}, {4, -1, 2});
  s.quad({2, -1, 0}, {2, 1, 0}, {4, 1, -2}, {4, -1, -2});
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -4, 0, 1, 4));
  for (const std::uint32_t t : {0U, 2U}) {
    for (const bool front : {true, false}) {
      bool drawn = false;
      for (const auto& r : map.regions)
        drawn |= r.visible && r.front == front && map.complex.pieces[r.piece].origins.front().triangle == t;
      if (!drawn) continue;
      EXPECT_FALSE(state_of(map, t, front).no_backface_cull);  // its plane cuts the cell
    }
  }
}

TEST(RenderStates, ALabelHoldsOnEverySightLine) {
  // Random sight lines to regions with NO_Z_COMPARE are free, and those to any region miss regions with NO_Z_WRITE.
  std::uint64_t free_lines = 0, labels = 0;
  for (const fuzz::Kind kind : {fuzz::Kind::tetrahedra, fuzz::Kind::axis_boxes, fuzz::Kind::nonconvex_solids}) {
    const auto scene = fuzz::generate(kind, 20261121, 1);
    SCOPED_TRACE(scene.name);
    const auto cell = exact::ConvexCell::from_doubles(scene.cell);
    if (cell.dimension() < 3) continue;
    const auto map = map_of(scene.mesh, cell);
    const exact::SceneQuery query(map.complex, map.cell);
    const auto states = reference::render_states(map);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto& r = map.regions[i];
      labels += states[i].no_z_compare + states[i].no_z_write + states[i].no_backface_cull;
      EXPECT_TRUE(r.visible || !(states[i].no_z_compare || states[i].no_z_write || states[i].no_backface_cull));
      if (!states[i].no_z_compare) continue;
      for (const exact::Point3& s : map.cell.vertices()) {
        const exact::Point3 v = CGAL::barycenter(s, exact::FT(9), map.cell.center(), exact::FT(1));
        if (map.complex.planes[r.piece].oriented_side(v) != (r.front ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE))
          continue;
        EXPECT_TRUE(query.is_free(v, r.sample));
        ++free_lines;
      }
    }
  }
  EXPECT_GT(free_lines, 0U);
  EXPECT_GT(labels, 0U);
}

TEST(DiscontinuityMesh, EveryInnerEdgeHasTwoFacesAndEveryFaceItsRings) {
  SceneBuilder s;
  s.plate(-2, -2, 2, 2, 1);
  s.plate(-10, -10, 10, 10, 2);
  const auto map = map_of(s.mesh(), box_cell(-1, -1, 0, 1, 1, 0));
  const auto mesh = reference::discontinuity_mesh(map);
  ASSERT_EQ(mesh.faces.size(), map.regions.size());
  std::map<std::uint64_t, std::size_t> edges_of;  // per face
  std::size_t ob = 0;
  for (const auto& e : mesh.edges) {
    ++edges_of[e.left];
    if (!e.right) {
      EXPECT_FALSE(e.boundary);
      continue;
    }
    ++edges_of[*e.right];
    EXPECT_LT(e.a, e.b);
    EXPECT_EQ(e.boundary, map.regions[e.left].visible != map.regions[*e.right].visible);
    ob += e.boundary;
  }
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    std::size_t corners = 0;
    for (const auto& ring : mesh.faces[i]) corners += ring.size();
    EXPECT_EQ(edges_of[i], corners);
  }
  std::size_t ob_segments = 0;
  for (const auto& d : map.segments) ob_segments += d.boundary;
  EXPECT_EQ(ob, ob_segments);
  EXPECT_GT(ob, 0U);
}

}  // namespace
}  // namespace clues::test
