// The exact visible set (D6) where the answer is known in closed form, to the last unit of a double.
#include "validate/visible_set/visible_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "exact/sight/witness.h"
#include "fuzz/generators/random_scenes.h"
#include "scene/messages/error.h"
#include "sight_scenes.h"

namespace clues::validate {
namespace {

using exact::ConvexCell;
using scene::Point;
using tests::box;
using tests::sight_of;
using Mesh = tests::SightMesh;

// Five slits in the planes z = 1 ... 5. A line (p + q z, z) is seen by slit i through f_i = n_i . (p + q z_i), linear in (p, q). The first
// four let |f_i| < 1/16 pass and f_5 = -4 f_1 - 4 f_2 + 7 f_3 + 2 f_4, so that f_5 < 17/16 for every line that passes them.
// The fifth lets f_5 > k pass. So the target behind it is seen if and only if k < 17/16.
struct Keyhole : Mesh {
  std::uint32_t target;
  explicit Keyhole(double k) {
    constexpr double g = 1 / 16., r = 8;
    half_plane(1, 0, g, 1);
    half_plane(-1, 0, g, 1);
    half_plane(0, 1, g, 2);
    half_plane(0, -1, g, 2);
    half_plane(1, 1, g, 3);
    half_plane(-1, -1, g, 3);
    half_plane(1, -1, g, 4);
    half_plane(-1, 1, g, 4);
    quad({r, k - 5 * r, 5}, {r - 20, k - 5 * r - 4, 5}, {-r - 20, k + 5 * r - 4, 5}, {-r, k + 5 * r, 5});
    target = triangle({-1, -1, 6}, {1, -1, 6}, {0, 1, 6});
  }
  // Covers n . x >= g as far as 8; n has entries -1, 0, 1.
  void half_plane(double nx, double ny, double g, double z) {
    constexpr double r = 8;
    const double s = nx * nx + ny * ny, x = nx * g / s, y = ny * g / s;
    quad({x + r * ny, y - r * nx, z}, {x + r * (ny + nx), y + r * (ny - nx), z},
         {x + r * (nx - ny), y + r * (ny + nx), z}, {x - r * ny, y + r * nx, z});
  }
};

// The coordinates near k + 40 are the longest: this moves them by one unit in the last place.
const double ulp = std::ldexp(1, -47);

TEST(VisibleSetKeyhole, OpensAndClosesByOneUnit) {
  const ConvexCell cell = box(.5, .5, -1, 0);
  EXPECT_EQ(sight_of(Keyhole(1), Keyhole(1).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(Keyhole(17 / 16. - ulp), Keyhole(1).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(Keyhole(17 / 16.), Keyhole(1).target, cell), Sight::hidden) << "one line touches five edges (D5)";
  EXPECT_EQ(sight_of(Keyhole(17 / 16. + ulp), Keyhole(1).target, cell), Sight::hidden);
}

TEST(VisibleSetKeyhole, FlatCell) {
  const ConvexCell cell = ConvexCell::from_doubles({{-.5, -.5, 0}, {.5, -.5, 0}, {.5, .5, 0}, {-.5, .5, 0}});
  EXPECT_EQ(sight_of(Keyhole(17 / 16. - ulp), Keyhole(1).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(Keyhole(17 / 16.), Keyhole(1).target, cell), Sight::hidden);
}

// The segment goes through the only viewpoint of the touching line, (-2/16, -3/16, 0).
TEST(VisibleSetKeyhole, SegmentAsCell) {
  const ConvexCell cell = ConvexCell::from_doubles({{0, 0, 0}, {-4 / 16., -6 / 16., 0}});
  EXPECT_EQ(sight_of(Keyhole(17 / 16. - ulp), Keyhole(1).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(Keyhole(17 / 16.), Keyhole(1).target, cell), Sight::hidden);
}

// From the origin, q_x + q_y < 1/48 and q_x - q_y < 1/64 bind: f_5 = 25 q_x + 5 q_y < 15/32.
TEST(VisibleSetKeyhole, PointAsCell) {
  const ConvexCell cell = ConvexCell::from_doubles({{0, 0, 0}});
  EXPECT_EQ(sight_of(Keyhole(15 / 32. - ulp), Keyhole(1).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(Keyhole(15 / 32.), Keyhole(1).target, cell), Sight::hidden);
}

TEST(VisibleSetEvents, AHoleBetweenThreeShadowsIsFound) {
  const tests::HoleBetweenShadows hole;
  EXPECT_EQ(sight_of(hole.scene.mesh, hole.target, hole.cell), Sight::visible);
}

TEST(VisibleSetCell, WhatLiesBehindTheCellBlocksNothing) {
  const tests::PlateBehindTheCell plate;
  EXPECT_EQ(sight_of(plate.mesh, plate.target, plate.cell), Sight::visible);
}

TEST(VisibleSetWindowLimit, IsReportedAsUndecided) {
  const Keyhole scene(17 / 16.);
  VisibleSetOptions options;
  options.trust_map = false;
  options.window_limit = 3;
  const auto set = exact_visible_set(scene, box(.5, .5, -1, 0), options);
  EXPECT_EQ(set.triangles[scene.target].sight, Sight::undecided);
  EXPECT_EQ(set.triangles[scene.target].proof, TriangleSight::Proof::none);
}

// Two walls in one plane; what is left open between them is [0, gap].
struct HalfWalls : Mesh {
  std::uint32_t target;
  explicit HalfWalls(double gap) {
    quad({-9, -9, 1}, {0, -9, 1}, {0, 9, 1}, {-9, 9, 1});
    quad({gap, -9, 1}, {9, -9, 1}, {9, 9, 1}, {gap, 9, 1});
    target = triangle({-1, -1, 2}, {1, -1, 2}, {0, 1, 2});
  }
};

TEST(VisibleSetHalfWalls, TheSmallestGapIsSeenAndNoGapIsNot) {
  const ConvexCell cell = box(.5, .5, -1, 0);
  const double smallest = std::numeric_limits<double>::denorm_min();
  for (const bool trust_map : {false, true}) {
    EXPECT_EQ(sight_of(HalfWalls(smallest), HalfWalls(1).target, cell, trust_map), Sight::visible);
    EXPECT_EQ(sight_of(HalfWalls(0), HalfWalls(1).target, cell, trust_map), Sight::hidden);
    EXPECT_EQ(sight_of(HalfWalls(-1), HalfWalls(1).target, cell, trust_map), Sight::hidden);
  }
}

// A wall through the cell: only what is outside int V blocks (D3). The line of sight below passes where the wall ends, at the face z = 0.
struct WallThroughCell : Mesh {
  std::uint32_t target;
  explicit WallThroughCell(double x) {
    quad({x, -9, -1}, {x, 9, -1}, {x, 9, 1}, {x, -9, 1});      // up through the cell to the lid
    quad({-9, -9, 1}, {x, -9, 1}, {x, 9, 1}, {-9, 9, 1});      // the lid, to the left
    quad({.5, -9, 0}, {9, -9, 0}, {9, 9, 0}, {.5, 9, 0});      // floor to the right of the cell
    quad({-9, -9, 0}, {-.5, -9, 0}, {-.5, 9, 0}, {-9, 9, 0});  // and to the left
    target = triangle({-3, -1, .75}, {-2, -1, .75}, {-2, 1, .75});
  }
};

TEST(VisibleSetCell, OccludersEndAtTheCell) {
  const ConvexCell cell = box(.5, .5, -1, 0);
  EXPECT_EQ(sight_of(WallThroughCell(0), WallThroughCell(0).target, cell), Sight::visible);
  EXPECT_EQ(sight_of(WallThroughCell(-.5), WallThroughCell(0).target, cell), Sight::hidden);
}

// An upside-down roof whose ridge (of length 0: whose tip) lies on the target: only the points of the ridge are seen, a set without area.
struct Groove : Mesh {
  std::uint32_t target;
  explicit Groove(double ridge) {
    target = triangle({-20, -20, 0}, {20, -20, 0}, {0, 20, 0});
    const Point a{-ridge, 0, 0}, b{ridge, 0, 0};
    const Point p{-100, -100, 50}, q{100, -100, 50}, r{100, 100, 50}, s{-100, 100, 50};
    if (ridge > 0) triangle(a, b, q);
    triangle(a, q, p);
    triangle(b, r, q);
    if (ridge > 0) triangle(b, a, s);
    triangle(b, s, r);
    triangle(a, p, s);
  }
};

TEST(VisibleSetGroove, ALineOrAPointWithoutAreaIsNotVisible) {
  const ConvexCell cell = box(.5, .5, 60, 61);
  for (const double ridge : {0., 1.}) {
    EXPECT_EQ(sight_of(Groove(ridge), 0, cell), Sight::hidden) << ridge;
    // The sight line itself is free: D5 does not ask what is at p.
    const auto seen =
        exact::check_witness(Groove(ridge), cell, 0, true, exact::Point3(0, 0, 60.5), exact::Point3(0, 0, 0));
    EXPECT_FALSE(seen.valid);
    EXPECT_NE(seen.reason.find("touches triangle 0 at p"), std::string::npos) << seen.reason;
  }
}

// Triangle 0 stands on the plane of a polygon as cell and hides all of it from the part of triangle 1 above; the
// part below sees it. No edge tells the two apart.
TEST(VisibleSetCell, ATriangleThroughThePlaneOfAPolygonIsSeenFromItsOtherSide) {
  Mesh mesh;
  mesh.triangle({-1, -3, 2}, {-1.5, 3, 1}, {1, .5, -1.5});
  const auto target = mesh.triangle({2, -3, -1}, {-2.796875, 3.21875, 0}, {-3.21875, -3.3203125, 2.3203125});
  const auto cell =
      ConvexCell::from_doubles({{.75, -1.25, .25}, {.375, -1.15625, .15625}, {-.53125, -2.3671875, 1.3671875}});
  EXPECT_EQ(sight_of(mesh, target, cell), Sight::visible);
}

TEST(VisibleSetMode, SolidsShowTheSameInBothModes) {
  std::uint64_t compared = 0, visible = 0, hidden = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const auto scene = fuzz::generate(fuzz::Kind::tetrahedra, 20261121, i);
    if (scene.mesh.triangles.size() % 4 != 0) continue;  // with a wall, which is open
    const auto cell = ConvexCell::from_doubles(scene.cell);
    VisibleSetOptions options;
    options.trust_map = false;
    const auto sheet = exact_visible_set(scene.mesh, cell, options);
    options.mode = reference::Mode::solid;
    const auto solid = exact_visible_set(scene.mesh, cell, options);
    ++compared;
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
      EXPECT_EQ(sheet.triangles[t].sight, solid.triangles[t].sight) << scene.name << " triangle " << t;
      visible += sheet.triangles[t].sight == Sight::visible ? 1 : 0;
      hidden += sheet.triangles[t].sight == Sight::hidden ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 0U);
  EXPECT_GT(visible, 0U);
  EXPECT_GT(hidden, 0U);
}

TEST(VisibleSetMode, AnOpenMeshIsRefusedAsSolid) {
  VisibleSetOptions options;
  options.mode = reference::Mode::solid;
  options.trust_map = false;
  EXPECT_THROW(exact_visible_set(HalfWalls(0), box(.5, .5, -1, 0), options), scene::Error);
}

TEST(VisibleSetInput, ATriangleWithoutAreaIsNoSurface) {
  Mesh mesh;
  const auto line = mesh.triangle({0, 0, 1}, {1, 0, 1}, {2, 0, 1});
  const auto inside = mesh.triangle({0, 0, -.5}, {1, 0, -.5}, {0, 1, -.5});
  const auto set = exact_visible_set(mesh, box(.5, .5, -1, 0));
  EXPECT_EQ(set.triangles[line].sight, Sight::no_surface);
  EXPECT_EQ(set.triangles[inside].sight, Sight::visible);
  EXPECT_TRUE(set.triangles[inside].meets_cell);
}

}  // namespace
}  // namespace clues::validate
