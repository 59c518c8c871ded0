// Shafts: nothing that meets the hull of triangle and cell is left out (exact hulls decide), and not much else is let in.
#include "fastpath/queries/shaft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/complex/complex.h"
#include "exact/sight/scene_query.h"
#include "fastpath/predicates/cell.h"
#include "fastpath/queries/segment_queries.h"
#include "fuzz/generators/city.h"
#include "fuzz/generators/random_scenes.h"
#include "oracle.h"
#include "scene/messages/error.h"
#include "tests/seed.h"

namespace clues::fastpath {
namespace {

// Triangles that exactly meet the hull of triangle t and the cell.
std::vector<std::uint32_t> meeting_hull(const scene::TriangleMesh& mesh, const Corners& t,
                                        const std::vector<Point>& cell) {
  std::vector<Point> points(t.begin(), t.end());
  points.insert(points.end(), cell.begin(), cell.end());
  const auto hull = exact::ConvexCell::from_doubles(points);
  std::vector<std::uint32_t> met;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    scene::TriangleMesh one;
    for (std::uint32_t k = 0; k < 3; ++k) one.points.push_back(mesh.points[mesh.triangles[i][k]]);
    one.triangles = {{0, 1, 2}};
    one.face_of = {0};
    const auto complex = exact::build_complex(one);
    if (!complex.pieces.empty() && exact::SceneQuery(complex, hull).meets_cell(0)) met.push_back(i);
  }
  return met;
}

TEST(Shaft, HoldsAllThatMeetsTheHull) {
  std::size_t proposed = 0, needed = 0, empty = 0;
  for (int round = 0; round < 36; ++round) {
    const auto scene =
        fuzz::generate(fuzz::all_kinds[static_cast<std::size_t>(round) % 6], kSeed, static_cast<std::uint64_t>(round));
    const auto mesh = moved(scene.mesh, 1, round % 2 == 0 ? 0 : 1e7);
    std::vector<Point> cell = scene.cell;
    for (Point& p : cell) {
      for (double& x : p) x += round % 2 == 0 ? 0 : 1e7;
    }
    const Bvh bvh(mesh);
    fuzz::Random random(kSeed + static_cast<std::uint64_t>(round));
    for (int i = 0; i < 3; ++i) {
      const auto t = static_cast<std::uint32_t>(random.between(0, static_cast<int>(mesh.triangles.size()) - 1));
      const Shaft shaft(bvh.frame(), bvh.corners(t), cell);
      const auto candidates = shaft_candidates_conservative(bvh, shaft);
      const auto met = meeting_hull(mesh, bvh.corners(t), cell);
      EXPECT_TRUE(std::includes(candidates.begin(), candidates.end(), met.begin(), met.end()))
          << scene.name << " " << t;
      proposed += candidates.size();
      needed += met.size();
      auto others = candidates;
      std::erase(others, t);
      const std::uint32_t ignored[] = {t};
      EXPECT_EQ(shaft_candidates_conservative(bvh, shaft, ignored), others);
      EXPECT_EQ(shaft_is_empty_conservative(bvh, shaft, ignored), others.empty());
      empty += others.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(needed, 300U);
  EXPECT_GT(empty, 0U);
  EXPECT_LT(proposed, needed + needed / 10);
}

// What blocks a segment between cell and triangle is in the shaft.
TEST(Shaft, HoldsAllThatBlocksASightLine) {
  constexpr std::uint32_t kTriangles = 3000;
  const auto city = fuzz::make_city(kTriangles, kSeed);
  const auto cell = fuzz::street_cell(kTriangles, kSeed);
  const Bvh bvh(city);
  SegmentQueries queries(bvh);
  fuzz::Random random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const Corners t =
        bvh.corners(static_cast<std::uint32_t>(random.between(0, static_cast<int>(city.triangles.size()) - 1)));
    const auto candidates = shaft_candidates_conservative(bvh, Shaft(bvh.frame(), t, cell));
    for (int k = 0; k < 20; ++k) {
      // Corners are exactly points of the hull.
      const Segment s{cell[static_cast<std::size_t>(random.between(0, 7))],
                      t[static_cast<std::size_t>(random.between(0, 2))]};
      for (const std::uint32_t hit : queries.all_hits(s))
        ASSERT_TRUE(std::binary_search(candidates.begin(), candidates.end(), hit));
    }
  }
}

// A planted bug: a shaft that forgets one corner of the cell.
TEST(Shaft, AForgottenCornerIsCaught) {
  int missed = 0;
  for (std::uint64_t index = 0; index < 10; ++index) {
    const auto scene = fuzz::generate(fuzz::Kind::loose_triangles, kSeed, index);
    const Bvh bvh(scene.mesh);
    for (std::uint32_t t = 0; t < 4; ++t) {
      const auto met = meeting_hull(scene.mesh, bvh.corners(t), scene.cell);
      for (std::size_t i = 0; i < scene.cell.size(); ++i) {
        auto fewer = scene.cell;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        const auto candidates = shaft_candidates_conservative(bvh, Shaft(bvh.frame(), bvh.corners(t), fewer));
        missed += std::includes(candidates.begin(), candidates.end(), met.begin(), met.end()) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(missed, 0);
}

TEST(Shaft, FarAndBadPoints) {
  const auto city = fuzz::make_city(300, kSeed);
  const Bvh bvh(city);
  const Point far[] = {{1e300, 1e300, 0}};
  const auto met = shaft_candidates_conservative(bvh, Shaft(bvh.frame(), bvh.corners(0), far));
  EXPECT_TRUE(std::binary_search(met.begin(), met.end(), 0U));
  const Point bad[] = {{NAN, 0, 0}};
  EXPECT_THROW(Shaft(bvh.frame(), bvh.corners(0), bad), scene::Error);
}

}  // namespace
}  // namespace clues::fastpath
