// The unit of length does not matter (D1): scenes times 2^k, for any k that doubles have room for, have the
// answers of the scene itself, times 2^k. Both kernels.
#include "exact/cell/standard_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fastpath/visibility/first_order.h"
#include "fastpath/visibility/refinement/refinement.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/hidden/umbra.h"
#include "reference/visibility/map/omega.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"
#include "scene/result.h"

namespace clues {
namespace {

constexpr std::uint64_t kRangeSeed = 20261123;
constexpr int kPowers[] = {-1068, -1000, -540, -100, 100, 480, 900};

using exact::ConvexCell;
using exact::FT;
using exact::Point3;
using fuzz::GeneratedScene;
using scene::Point;

std::vector<Point> scaled(std::vector<Point> points, int power) {
  for (Point& p : points) {
    for (double& x : p) {
      const double before = x;
      x = std::ldexp(x, power);
      EXPECT_EQ(std::ldexp(x, -power), before);
    }
  }
  return points;
}

GeneratedScene scaled(GeneratedScene scene, int power) {
  scene.mesh.points = scaled(scene.mesh.points, power);
  scene.cell = scaled(scene.cell, power);
  return scene;
}

Point3 scaled(const Point3& p, int power) {
  const FT half(std::ldexp(1.0, power / 2)), rest(std::ldexp(1.0, power - power / 2));
  return Point3(p.x() * half * rest, p.y() * half * rest, p.z() * half * rest);
}

std::vector<GeneratedScene> scenes(std::uint64_t of_each) {
  std::printf("seed %lu\n", kRangeSeed);
  std::vector<GeneratedScene> all;
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    for (std::uint64_t i = 0; i < of_each; ++i) all.push_back(fuzz::generate(kind, kRangeSeed, i));
  }
  return all;
}

reference::Options one_thread() {
  reference::Options options;
  options.threads = 1;
  return options;
}

// In an order of their own: that of the faces of an arrangement is not promised.
using Ring = std::vector<Point3>;
using Regions = std::vector<std::tuple<std::uint32_t, bool, std::vector<Ring>, bool, FT>>;
Regions regions_of(const reference::VisibilityMap& map, int power) {
  Regions all;
  for (const reference::Region& r : map.regions) {
    std::vector<Ring> rings;
    for (const Ring& ring : r.rings) {
      Ring& moved = rings.emplace_back();
      for (const Point3& p : ring) moved.push_back(scaled(p, power));
      std::rotate(moved.begin(), std::min_element(moved.begin(), moved.end()), moved.end());
    }
    std::sort(rings.begin() + 1, rings.end());
    all.emplace_back(r.piece, r.front, std::move(rings), r.visible, r.area_fraction);
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_scaled(const reference::VisibilityMap& one, const reference::VisibilityMap& map, int power) {
  EXPECT_EQ(map.visible, one.visible);
  EXPECT_FALSE(map.range.moves());
  const auto same = [&](const Point3& at_one, const Point3& p) { EXPECT_EQ(scaled(at_one, power), p); };
  ASSERT_EQ(map.complex.points.size(), one.complex.points.size());
  for (std::size_t i = 0; i < one.complex.points.size(); ++i) same(one.complex.points[i], map.complex.points[i]);
  for (std::size_t i = 0; i < one.complex.planes.size(); ++i) {
    const exact::Piece& piece = map.complex.pieces[i];
    for (const std::uint32_t c : piece.corners) EXPECT_TRUE(map.complex.planes[i].has_on(map.complex.points[c]));
  }
  ASSERT_EQ(map.cell.vertices().size(), one.cell.vertices().size());
  for (std::size_t i = 0; i < one.cell.vertices().size(); ++i) same(one.cell.vertices()[i], map.cell.vertices()[i]);
  EXPECT_EQ(regions_of(map, 0), regions_of(one, power));
  ASSERT_EQ(map.segments.size(), one.segments.size());
  for (std::size_t i = 0; i < one.segments.size(); ++i) {
    same(one.segments[i].a, map.segments[i].a);
    same(one.segments[i].b, map.segments[i].b);
  }
  ASSERT_EQ(map.wedges.size(), one.wedges.size());
  for (std::size_t i = 0; i < one.wedges.size(); ++i) {
    const reference::Wedge &a = one.wedges[i], &b = map.wedges[i];
    same(a.center, b.center);
    same(a.near0, b.near0);
    same(a.near1, b.near1);
    ASSERT_EQ(a.unbounded, b.unbounded);
    if (!a.unbounded) {
      same(a.far0, b.far0);
      same(a.far1, b.far1);
    }
    EXPECT_TRUE(b.plane.has_on(b.center) && b.plane.has_on(b.on_ray0) && b.plane.has_on(b.on_ray1));
  }
}

// So what holds at one power holds at all of them.
TEST(StandardRange, EveryScaleIsMovedToOneScene) {
  for (const GeneratedScene& scene : scenes(20)) {
    const GeneratedScene far = scaled(scene, 200);
    const exact::StandardRange range(far.mesh, far.cell);
    for (const int power : kPowers) {
      const GeneratedScene moved = scaled(scene, power);
      const exact::StandardRange to(moved.mesh, moved.cell);
      EXPECT_EQ(to.moved_in(moved.mesh).points, range.moved_in(far.mesh).points) << scene.name << " 2^" << power;
      EXPECT_EQ(to.moved_in(moved.cell), range.moved_in(far.cell));
    }
  }
}

TEST(StandardRange, TheReferenceGivesTheSameMapAtEveryScale) {
  for (const GeneratedScene& scene : scenes(1)) {
    const auto one = reference::first_order_visibility(scene.mesh, ConvexCell::from_doubles(scene.cell), one_thread());
    for (const int power : {-1068, 900}) {
      SCOPED_TRACE(scene.name + " times 2^" + std::to_string(power));
      const GeneratedScene moved = scaled(scene, power);
      const ConvexCell cell = ConvexCell::from_doubles(moved.cell);
      expect_scaled(one, reference::first_order_visibility(moved.mesh, cell, one_thread()), power);
    }
  }
}

// The file is made from the map in the standard range, which is not that of scale 1.
TEST(StandardRange, ResultsAreInTheCoordinatesOfTheScene) {
  for (const fuzz::Kind kind : {fuzz::Kind::open_sheets, fuzz::Kind::interpenetrating}) {
    const GeneratedScene scene = fuzz::generate(kind, kRangeSeed, 0);
    for (const int power : {-540, 480}) {
      SCOPED_TRACE(scene.name + " times 2^" + std::to_string(power));
      const GeneratedScene moved = scaled(scene, power);
      const scene::CellSpec spec{"", moved.cell};
      const ConvexCell cell = ConvexCell::from_doubles(moved.cell);
      const auto in_range = reference::Omega(moved.mesh, cell, one_thread()).take_map();
      EXPECT_TRUE(in_range.range.moves());
      const auto back = reference::first_order_visibility(moved.mesh, cell, one_thread());
      const std::string text = scene::to_json_text(reference::to_result(in_range, spec, true, true));
      EXPECT_EQ(text, scene::to_json_text(reference::to_result(back, spec, true, true)));
      EXPECT_THAT(text, testing::Not(testing::HasSubstr("nan")));
    }
  }
}

TEST(StandardRange, TheFastPathGivesTheSameMapAtEveryScale) {
  for (const GeneratedScene& scene : scenes(3)) {
    const auto one = fastpath::first_order_visibility(fastpath::Bvh(scene.mesh), scene.cell, {}, {.regions = true});
    for (const int power : kPowers) {
      SCOPED_TRACE(scene.name + " times 2^" + std::to_string(power));
      const GeneratedScene moved = scaled(scene, power);
      const auto map = fastpath::first_order_visibility(fastpath::Bvh(moved.mesh), moved.cell, {}, {.regions = true});
      EXPECT_EQ(map.visible, one.visible);
      EXPECT_EQ(map.conservative_fallbacks, one.conservative_fallbacks);
      ASSERT_EQ(map.regions.size(), one.regions.size());
      for (std::size_t i = 0; i < one.regions.size(); ++i) {
        EXPECT_EQ(map.regions[i].triangle, one.regions[i].triangle);
        EXPECT_EQ(map.regions[i].visible, one.regions[i].visible);
        ASSERT_EQ(map.regions[i].outline_estimate.size(), one.regions[i].outline_estimate.size());
        for (std::size_t k = 0; k < one.regions[i].outline_estimate.size(); ++k) {
          for (std::size_t j = 0; j < 3; ++j) {
            const double x = one.regions[i].outline_estimate[k][j], y = map.regions[i].outline_estimate[k][j];
            EXPECT_NEAR(std::ldexp(y, -power), x,
                        power < -1000 ? 1 : 1e-9);  // estimates; there as coarse as doubles are
          }
        }
      }
    }
  }
}

TEST(StandardRange, RefinementGivesTheSameAtEveryScale) {
  for (const fuzz::Kind kind : {fuzz::Kind::loose_triangles, fuzz::Kind::tetrahedra}) {
    const GeneratedScene scene = fuzz::generate(kind, kRangeSeed, 0);
    for (const int power : {-540, 480}) {
      SCOPED_TRACE(scene.name + " times 2^" + std::to_string(power));
      const GeneratedScene moved = scaled(scene, power);
      const auto refined = [](const GeneratedScene& s) {
        reference::Bounds bounds(s.mesh, ConvexCell::from_doubles(s.cell), one_thread());
        reference::refine_by_cells(bounds, {1, 0, false});
        return moved_back(bounds.refined_map("subdivided"));
      };
      const double tolerance = std::ldexp(0.5, std::clamp(2 * power, -1074, 1000));
      expect_scaled(refined(scene), refined(moved), power);
      fastpath::RefinementOptions options;
      options.max_depth = 2;
      options.by = fastpath::RefineBy::both;
      options.regions = true;
      const auto one = fastpath::refined_visibility(fastpath::Bvh(scene.mesh), scene.cell, {}, options);
      const auto map = fastpath::refined_visibility(fastpath::Bvh(moved.mesh), moved.cell, {}, options);
      EXPECT_EQ(map.visible, one.visible);
      ASSERT_EQ(map.depths.size(), one.depths.size());
      options.tolerance_area = tolerance;
      for (const auto& d : fastpath::refined_visibility(fastpath::Bvh(moved.mesh), moved.cell, {}, options).depths)
        EXPECT_FALSE(std::isnan(d.refined_area) || std::isnan(d.witnessed_area));
    }
  }
}

TEST(StandardRange, TheUmbraIsInTheCoordinatesOfTheScene) {
  const GeneratedScene scene = fuzz::generate(fuzz::Kind::tetrahedra, kRangeSeed, 0);
  const reference::Box box{Point3(-64, -64, -64), Point3(64, 64, 64)};
  const auto umbra_of = [&](int power) {
    const GeneratedScene moved = scaled(scene, power);
    const reference::Omega omega(moved.mesh, ConvexCell::from_doubles(moved.cell), one_thread());
    return reference::build_umbra(omega, reference::Box{scaled(box.lo, power), scaled(box.hi, power)}, 1);
  };
  const reference::Umbra one = umbra_of(0);
  EXPECT_FALSE(one.facets.empty());
  for (const int power : {-540, 480}) {
    const reference::Umbra umbra = umbra_of(power);
    EXPECT_EQ(umbra.bounds.hi, scaled(box.hi, power));
    ASSERT_EQ(umbra.facets.size(), one.facets.size());
    for (std::size_t i = 0; i < one.facets.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(umbra.facets[i].corners[k], scaled(one.facets[i].corners[k], power));
    }
  }
}

}  // namespace
}  // namespace clues
