// The pieces that refinement in the fast path is made of: parts that cover the cell, areas that add up; and that the answer is the same for any number of threads and any
// order of triangles.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "exact/complex/cell_cut.h"
#include "fastpath/visibility/refinement/adjusted_cut.h"
#include "fastpath/visibility/refinement/area_bounds.h"
#include "fuzz/generators/random.h"
#include "fuzz/generators/random_scenes.h"
#include "slit_scenes.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

// Random planes through cells of all dimensions, and through the parts again: each half lies in the part for its side, and the parts in the cell.
TEST(FastRefinement, PartsCoverTheCell) {
  fuzz::Random random(kSeed);
  const auto number = [&] { return random.between(-1000000, 1000000) * 0x1.123456789p-20; };
  std::uint64_t cut = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<Point> points;
    const int corners = random.between(2, 8);
    for (int k = 0; k < corners; ++k) points.push_back({number(), number(), number()});
    std::vector<exact::ConvexCell> cells{exact::ConvexCell::from_doubles(points)};
    for (int depth = 0; depth < 2; ++depth) {
      std::vector<exact::ConvexCell> next;
      for (const exact::ConvexCell& cell : cells) {
        const CutPlane plane{{number() / 4, number() / 4, number() / 4}, {number(), number(), number()}};
        const exact::Plane3 exact_plane(exact::to_exact(plane.base),
                                        exact::Vector3(plane.normal[0], plane.normal[1], plane.normal[2]));
        const auto below = part_beside(cell, exact_plane, exact::Side::negative);
        const auto above = part_beside(cell, exact_plane, exact::Side::positive);
        const auto parts = parts_along(cell, plane);
        ASSERT_EQ(parts.size(), below && above ? 2U : 1U);
        for (const exact::ConvexCell& part : parts) {
          EXPECT_EQ(part.dimension(), cell.dimension());
          for (const exact::Point3& v : part.vertices()) EXPECT_TRUE(cell.contains(v));
          next.push_back(part);
        }
        if (parts.size() < 2) continue;
        ++cut;
        for (const exact::Point3& v : below->vertices()) EXPECT_TRUE(parts[0].contains(v));
        for (const exact::Point3& v : above->vertices()) EXPECT_TRUE(parts[1].contains(v));
      }
      cells = std::move(next);
    }
  }
  EXPECT_GT(cut, 50U);
}

LocalRegion region(const std::vector<Point>& outline, double area, bool visible = true) {
  return {0, true, visible, outline, area};
}

TEST(FastRefinement, AreasAddUp) {
  // A square of which the right part is hidden; a viewpoint sees the left quarter, parts see the lower half and the uppermost quarter.
  AreaBounds areas({region({{0, 0, 0}, {4, 0, 0}, {4, 8, 0}, {0, 8, 0}}, 32),
                    region({{4, 0, 0}, {8, 0, 0}, {8, 8, 0}, {4, 8, 0}}, 32, false)});
  EXPECT_EQ(areas.first_order(), 32);
  areas.witness({region({{0, 0, 0}, {2, 0, 0}, {2, 8, 0}, {0, 8, 0}}, 16)});
  EXPECT_EQ(areas.witnessed(), 16);
  EXPECT_EQ(areas.in_doubt(), 16);
  const std::vector<LocalRegion> lower{region({{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {0, 4, 0}}, 32)},
      upper{region({{0, 6, 0}, {8, 6, 0}, {8, 8, 0}, {0, 8, 0}}, 16)};
  EXPECT_TRUE(areas.reach_doubt(upper));
  areas.restrict_to({&lower, &upper}, {true});
  EXPECT_NEAR(areas.refined(), 28, 1e-9);
  EXPECT_TRUE(areas.in_doubt(0));
  EXPECT_FALSE(areas.reach_doubt({region({{2, 4, 0}, {4, 4, 0}, {4, 6, 0}, {2, 6, 0}}, 4)}));
  double all = 0;
  for (const LocalRegion& r : areas.regions()) all += r.area_estimate;
  EXPECT_NEAR(all, 64, 1e-9);
}

// --- the same answer --------------------------------------------------------------------------------------------------------

TEST(FastRefinement, IsTheSameForAnyNumberOfThreads) {
  const Scene s = slits_and_tiles();
  RefinementOptions options;
  options.by = RefineBy::both;
  options.max_depth = 2;
  options.regions = true;
  std::vector<RefinedVisibility> found;
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { found.push_back(refine(s.mesh, s.cell, options)); });
  }
  for (const RefinedVisibility& f : found) {
    EXPECT_EQ(f.visible, found[0].visible);
    ASSERT_EQ(f.depths.size(), found[0].depths.size());
    EXPECT_EQ(f.depths.back().refined_area, found[0].depths.back().refined_area);
    EXPECT_EQ(f.depths.back().witnessed, found[0].depths.back().witnessed);
    ASSERT_EQ(f.first_order.regions.size(), found[0].first_order.regions.size());
    for (std::size_t i = 0; i < f.first_order.regions.size(); ++i)
      EXPECT_EQ(f.first_order.regions[i].outline_estimate, found[0].first_order.regions[i].outline_estimate);
  }
}

TEST(FastRefinement, DoesNotDependOnTheOrderOfTriangles) {
  const Scene s = slits_and_tiles();
  scene::TriangleMesh reversed = s.mesh;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  RefinementOptions options;
  options.max_depth = 2;
  for (const RefineBy by : {RefineBy::cells, RefineBy::backprojection}) {
    options.by = by;
    Ids visible = refine(reversed, s.cell, options).visible;
    for (std::uint32_t& t : visible) t = static_cast<std::uint32_t>(reversed.triangles.size()) - 1 - t;
    std::sort(visible.begin(), visible.end());
    EXPECT_EQ(visible, refine(s.mesh, s.cell, options).visible);
  }
}

TEST(FastRefinement, CellsOfAllDimensionsAndTolerance) {
  Scene s = slits_and_tiles();
  RefinementOptions options;
  options.max_depth = 2;
  options.regions = true;
  for (const auto& [lo, hi] :
       {std::pair<Point, Point>{{-1, -1, 0}, {1, 1, 0.5}}, {{-1, -1, 0}, {1, 1, 0}}, {{-1, 0.25, 0}, {1, 0.25, 0}}}) {
    const auto depths = refine(s.mesh, box(lo, hi), options).depths;
    EXPECT_GE(depths.back().parts, 2U);
    EXPECT_LT(depths.back().refined_area - depths.back().witnessed_area,
              depths.front().refined_area - depths.front().witnessed_area);
    RefinementOptions loose = options;
    loose.tolerance_area = 1.001 * (depths.front().refined_area - depths.front().witnessed_area);
    EXPECT_EQ(refine(s.mesh, box(lo, hi), loose).depths.back().depth, 0) << "that is good enough at once";
  }
  const auto point = refine(s.mesh, {{0, 0, 0}}, options);
  EXPECT_EQ(point.depths.back().parts, 1U);
  EXPECT_NEAR(point.depths.back().refined_area, point.depths.back().witnessed_area, 1e-9)
      << "from a point first order is exact";
}

TEST(FastRefinement, EmptySceneAndSolidMode) {
  const scene::TriangleMesh nothing;
  EXPECT_EQ(refine(nothing, {{0, 0, 0}}, {}).visible, Ids{});
  for (std::uint64_t i = 0; i < 3; ++i) {
    const auto scene = fuzz::generate(fuzz::Kind::tetrahedra, kSeed, i);
    const Bvh bvh(scene.mesh);
    LocalMapOptions solid;
    solid.mode = SideMode::solid;
    const auto found = refined_visibility(bvh, scene.cell, solid, {});
    EXPECT_EQ(missing_from(found.visible, found.first_order.visible), Ids{});
    for (const RefinementFigures& f : found.depths) EXPECT_LE(f.witnessed, f.visible);
  }
}

}  // namespace
}  // namespace clues::fastpath
