// Cutting the cell (D21) in the fast path and in the reference: the same parts, and so the same triangles and areas, by two ways that share only the cutting of cells.
#include "fastpath/visibility/refinement/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "fuzz/campaign/generators.h"
#include "fuzz/generators/random_scenes.h"
#include "reference/visibility/refinement/bounds.h"
#include "reference/visibility/refinement/subdivision.h"
#include "tests/seed.h"

namespace clues {
namespace {

struct Tally {
  std::uint64_t scenes = 0, less = 0, less_area = 0, same_area = 0, fallbacks = 0;
};

// Of the reference's bounds, triangle by triangle: a surface that two triangles share counts for both, as in the fast path.
struct Areas {
  Areas(const reference::Bounds& bounds, const scene::TriangleMesh& mesh) {
    double largest = 0, extent = 0;
    for (const scene::Point& p : mesh.points) {
      for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(p[k]));
        extent = std::max(extent, std::abs(p[k] - mesh.points[0][k]));
      }
    }
    for (const reference::TriangleBounds& t : bounds.by_triangle()) {
      const auto corner = [&](std::size_t i) { return exact::to_exact(mesh.points[mesh.triangles[t.triangle][i]]); };
      const double whole = std::sqrt(CGAL::to_double(CGAL::squared_area(corner(0), corner(1), corner(2))));
      first_order += whole * CGAL::to_double(t.first_order);
      upper += whole * CGAL::to_double(t.upper);
      lower += whole * CGAL::to_double(t.lower);
    }
    // The fast path's corners are doubles of the scene: far from the origin they are coarse.
    rounding = 1e-8 * (1 + first_order) + 0x1p-50 * largest * extent * static_cast<double>(mesh.triangles.size());
  }
  double first_order = 0, upper = 0, lower = 0, rounding = 0;
};

// A triangle that both kernels have no sight line to is asked about in all parts that may see it, by both; one that either has a sight line to is listed by both.
// So the lists are equal, where no map has a fallback.
void compare(const scene::TriangleMesh& mesh, const std::vector<scene::Point>& cell, int depth, Tally& tally) {
  reference::Options options;
  options.threads = 1;
  options.check_two_walks = false;
  reference::Bounds bounds(mesh, exact::ConvexCell::from_doubles(cell), options);
  refine_by_cells(bounds, {depth, 0});
  const auto exact = bounds.refined_map("subdivided");

  const fastpath::Bvh bvh(mesh);
  fastpath::RefinementOptions refinement;
  refinement.max_depth = depth;
  refinement.sight_lines = 0;  // all triangles are asked about in all parts
  const auto fast = fastpath::refined_visibility(bvh, cell, {}, refinement);
  ++tally.scenes;
  const std::uint64_t fallbacks =
      exact.statistics.conservative_fallbacks + fast.conservative_fallbacks + fast.first_order.conservative_fallbacks;
  tally.fallbacks += fallbacks;
  tally.less += fast.visible.size() < fast.first_order.visible.size();
  if (fallbacks > 0) return;
  EXPECT_EQ(fast.visible, exact.visible);

  refinement.sight_lines = fastpath::RefinementOptions{}.sight_lines;
  refinement.regions = true;
  const auto with_areas = fastpath::refined_visibility(bvh, cell, {}, refinement);
  EXPECT_EQ(with_areas.visible, exact.visible);
  const Areas area(bounds, mesh);
  const fastpath::RefinementFigures& last = with_areas.depths.back();
  // D3: what lies in the cell is known to be seen there, and in doubt nowhere here; both count it.
  EXPECT_NEAR(last.first_order_area, area.first_order, area.rounding);
  // What the reference leaves alone as known, here there may be no sight line to yet: then more parts are cut, and less is left.
  EXPECT_LE(last.refined_area, area.upper + area.rounding);
  EXPECT_GE(last.refined_area, area.lower - area.rounding);
  tally.same_area += std::abs(last.refined_area - area.upper) <= area.rounding;
  tally.less_area += last.refined_area < last.first_order_area * (1 - 1e-6);
}

void compare_kinds(std::uint64_t per_kind, int depth, std::size_t most_triangles, Tally& tally) {
  for (const fuzz::Kind kind : fuzz::all_kinds) {
    std::uint64_t done = 0;
    for (std::uint64_t i = 0; done < per_kind && i < 20 * per_kind; ++i) {
      const fuzz::GeneratedScene scene = fuzz::generate(kind, kSeed, i);
      if (scene.mesh.triangles.size() > most_triangles) continue;
      SCOPED_TRACE(scene.name);
      compare(scene.mesh, scene.cell, depth, tally);
      ++done;
    }
  }
}

void print(const Tally& t) {
  std::cout << "seed " << kSeed << ": " << t.scenes << " scenes, " << t.less << " with fewer triangles and "
            << t.less_area << " with less area than first-order, " << t.same_area << " with the area of the reference, "
            << t.fallbacks << " fallbacks\n";
}

// Two slits that cross each other, in walls at z = 2 and 4, before a floor of tiles: many tiles that only look visible to first order.
std::vector<scene::Point> box_cell() {
  std::vector<scene::Point> corners;
  for (unsigned i = 0; i < 8; ++i) corners.push_back({i & 1U ? 1. : -1., i & 2U ? 1. : -1., i & 4U ? 0.5 : 0.});
  return corners;
}

scene::TriangleMesh slits_and_tiles() {
  scene::TriangleMesh mesh;
  const auto quad = [&](const std::array<scene::Point, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
    for (const std::uint32_t i : {1U, 2U}) {
      mesh.triangles.push_back({first, first + i, first + i + 1});
      mesh.face_of.push_back(static_cast<std::uint32_t>(mesh.face_of.size()));
    }
  };
  for (const double s : {1., -1.}) {
    quad({{{-8, s * 0.125, 2}, {8, s * 0.125, 2}, {8, s * 8, 2}, {-8, s * 8, 2}}});
    quad(
        {{{-8, 8 + s * 0.25, 4}, {8, -8 + s * 0.25, 4}, {8 + s * 8, -8 + s * 8.25, 4}, {-8 + s * 8, 8 + s * 8.25, 4}}});
  }
  for (int x = -3; x < 3; ++x) {
    for (int y = -2; y < 2; ++y)
      quad({{{x * 1., y * 1., 6}, {x + 1., y * 1., 6}, {x + 1., y + 1., 6}, {x * 1., y + 1., 6}}});
  }
  return mesh;
}

TEST(RefinementOfBothKernels, CutsTheSameAway) {
  Tally tally;
  compare(slits_and_tiles(), box_cell(), 2, tally);
  EXPECT_EQ(tally.less, 1U);
  EXPECT_EQ(tally.fallbacks, 0U);
  compare_kinds(1, 2, 16, tally);
  EXPECT_GT(tally.less_area, 0U);
  print(tally);
}

// Regions with corners 1e-15 apart, whose edges point anywhere: an area of 0.1 was called hidden.
TEST(RefinementOfBothKernels, CornersThatAreOneButForRoundingsCutNothingOff) {
  Tally tally;
  const fuzz::GeneratedScene scene = fuzz::generate(fuzz::Kind::loose_triangles, kSeed, 17);
  compare(scene.mesh, scene.cell, 1, tally);
  EXPECT_EQ(tally.fallbacks, 0U);
  EXPECT_EQ(tally.same_area, 1U);
}

TEST(RefinementOfBothKernelsLong, CutsTheSameAway) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  Tally tally;
  compare_kinds(15, 3, 32, tally);
  const fuzz::GivenScenes none;
  for (const fuzz::NamedGenerator& generator : fuzz::generators_named({}, none)) {
    for (std::uint64_t i = 0; i < 4; ++i) {
      const fuzz::Case c = generator.make(kSeed, i);
      if (c.mesh.triangles.size() > 32) continue;
      SCOPED_TRACE(generator.name + "-" + std::to_string(kSeed) + "-" + std::to_string(i));
      compare(c.mesh, c.cell, 2, tally);
    }
  }
  print(tally);
}

}  // namespace
}  // namespace clues
