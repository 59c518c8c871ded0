// FIG. 20B: planes that meet in place of swept wedges, on a scene whose areas are known, and on random ones.
#include "reference/visibility/hidden/inside_corners.h"

#include <gtest/gtest.h>

#include <iostream>

#include "fuzz/generators/random_scenes.h"
#include "judges.h"
#include "reference/visibility/hidden/effective_occlusion.h"
#include "support.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::InsideCorner;
using reference::SimplifiedMap;
using reference::VisibilityMap;

SimplifiedMap by_planes(const VisibilityMap& map, double degrees, int threads = 1) {
  reference::OcclusionControls controls;
  controls.threads = threads;
  controls.corner_angle = degrees;
  return with_simpler_occlusion(map, controls);
}

std::string bytes_of(const VisibilityMap& map) { return scene::to_json_text(reference::to_result(map, {}, true)); }

// A wall at z = 1 with the hole |x| + |y| < 1, and one triangle at z = 2. The cell [-1, 1]^2 lights an octagon there, |x| + |y| < 4 with |x|, |y| < 3: its short
// edges are swept, and the planes of the others meet in (4, 0) and so on, 25.35 degrees from the swept wedges.
struct DiamondHole {
  SceneBuilder s;
  std::uint32_t receiver;
  exact::ConvexCell cell = box_cell(-1, -1, -1, 1, 1, 0);
  DiamondHole() {
    const std::array<std::array<double, 2>, 4> hole{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}},
        rim{{{32, 32}, {-32, 32}, {-32, -32}, {32, -32}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto &a = hole[i], &b = hole[(i + 1) % 4], &c = rim[i], &d = rim[(i + 3) % 4];
      s.triangle({a[0], a[1], 1}, {c[0], c[1], 1}, {b[0], b[1], 1});
      s.triangle({a[0], a[1], 1}, {d[0], d[1], 1}, {c[0], c[1], 1});
    }
    receiver = s.triangle({-24, -24, 2}, {24, -24, 2}, {0, 28, 2});
  }
};

TEST(InsideCorners, ADiamondShapedHole) {
  const DiamondHole it;
  const VisibilityMap map = map_of(it.s.mesh(), it.cell);
  const FT whole(48 * 52 / 2);
  ASSERT_EQ(hidden_area(map, it.s.mesh(), it.receiver, 1, false), whole - FT(28));
  std::size_t within = 0;
  for (const InsideCorner& c : inside_corners(map)) within += c.within(25.36) && !c.within(25.34);
  EXPECT_EQ(within, 4U);

  const SimplifiedMap swept = by_planes(map, 25.34), planes = by_planes(map, 25.36);
  EXPECT_EQ(bytes_of(swept.map), bytes_of(map));
  EXPECT_EQ(swept.by_planes, 0U);
  EXPECT_EQ(planes.by_planes, 4U);
  EXPECT_EQ(planes.before.segments, 8U);
  EXPECT_EQ(planes.after.segments, 4U);
  EXPECT_EQ(hidden_area(planes.map, it.s.mesh(), it.receiver, 1, false), whole - FT(32));
  EXPECT_EQ(planes.map.visible, map.visible);
}

// B-25: a chain that begins at the line of intersection and ends far from it. By its smallest angle, which is nothing, it would be given up at any threshold.
TEST(InsideCorners, HazardB25TheLargestAngleCounts) {
  InsideCorner corner;
  corner.x = exact::Point3(0, 0, 0);
  corner.line = exact::Vector3(0, 0, 1);
  const exact::Vector3 near(0, 0, 2), far(1, 0, 1);
  corner.chain.push_back({exact::Plane3(corner.x, exact::Vector3(0, 1, 0)), near, far});
  EXPECT_FALSE(corner.within(44.9));
  EXPECT_TRUE(corner.within(45.1));
  EXPECT_TRUE(corner.within(90));
}

// The line of intersection has two directions (B-25). Along the wrong one nothing is hidden by the planes.
TEST(InsideCorners, HazardB25TheLineContinuesBothWedges) {
  const DiamondHole it;
  const VisibilityMap map = map_of(it.s.mesh(), it.cell);
  for (const InsideCorner& c : inside_corners(map)) EXPECT_GT(c.line.z(), FT(0)) << "away from the cell";
}

TEST(InsideCorners, NothingBecomesHiddenInRandomScenes) {
  std::uint64_t corners = 0, taken = 0, before = 0, after = 0;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < 5; ++i) {
      const auto scene = fuzz::generate(kind, 20261121, i);
      if (scene.mesh.triangles.size() > 30) continue;
      SCOPED_TRACE(scene.name);
      const VisibilityMap map = map_of(scene.mesh, exact::ConvexCell::from_doubles(scene.cell));
      const SimplifiedMap planes = by_planes(map, 60);
      EXPECT_TRUE(reference::hides_no_more(map, planes.map));
      EXPECT_LE(planes.after.segments, planes.before.segments);
      EXPECT_EQ(planes.by_planes > 0, planes.after.segments < planes.before.segments);
      EXPECT_EQ(bytes_of(planes.map), bytes_of(by_planes(map, 60, 2).map));
      if (planes.by_planes > 0) {
        EXPECT_EQ(contradictions(planes.map, 2, 1).total(), 0U);
      }
      corners += planes.inside_corners;
      taken += planes.by_planes;
      before += planes.before.segments;
      after += planes.after.segments;
    }
  }
  EXPECT_GT(taken, 0U);
  std::cout << corners << " inside corners, " << taken << " by planes, boundary segments " << before << " -> " << after
            << "\n";
}

}  // namespace
}  // namespace clues::test
