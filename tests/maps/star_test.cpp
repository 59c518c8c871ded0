// One star: flattened, closed, written in weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fuzz/generators/parts.h"
#include "fuzz/multires/surfaces.h"
#include "reference/multires/overlay.h"
#include "reference/multires/stars/flattening.h"
#include "reference/multires/stars/hole.h"
#include "reference/multires/stars/priority.h"

namespace clues {
namespace {

using exact::DiskPoint;
using reference::HolePolygon;

const auto nothing_forbidden = [](std::uint32_t, std::uint32_t) { return false; };

// Eight points on one circle, exactly.
HolePolygon cocircular(const std::vector<std::uint32_t>& numbers) {
  HolePolygon polygon;
  for (const DiskPoint& p : {DiskPoint{7, 1}, {5, 5}, {1, 7}, {-1, 7}, {-5, 5}, {-7, 1}, {-7, -1}, {-5, -5}}) {
    polygon.points.push_back({p[0] * 1000, p[1] * 1000});
  }
  polygon.vertices = numbers;
  return polygon;
}

TEST(Hole, CocircularCornersMakeAFanAtTheLowest) {
  std::vector<std::uint32_t> numbers{30, 4, 12, 9, 25, 7, 18, 11};
  for (int turn = 0; turn < 8; ++turn) {
    std::rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
    const auto triangles = reference::triangulated(cocircular(numbers), nothing_forbidden);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(triangles->size(), 6U);
    for (const auto& t : *triangles) EXPECT_EQ(t[0], 4U);
  }
}

TEST(Hole, AvoidsEdgesThatExist) {
  const std::vector<std::uint32_t> numbers{0, 1, 2, 3, 4, 5, 6, 7};
  const auto forbidden = [](std::uint32_t a, std::uint32_t b) {
    return a == 0 || b == 0 || (a == 1 && b == 7) || (a == 7 && b == 1);
  };
  EXPECT_FALSE(reference::triangulated(cocircular(numbers), forbidden));  // corner 0 can be cut off by (1, 7) only
  const auto without_fan = [](std::uint32_t a, std::uint32_t b) { return a == 0 || b == 0; };
  const auto triangles = reference::triangulated(cocircular(numbers), without_fan);
  ASSERT_TRUE(triangles);
  for (const auto& t : *triangles) EXPECT_TRUE(t[0] != 0 || t == (scene::Triangle{0, 1, 7}));
}

TEST(Hole, IsTheOnlyWayRoundAReflexCorner) {
  const HolePolygon polygon{{{10, 0}, {1, 1}, {0, 10}, {-10, -10}}, {5, 6, 7, 8}};
  const auto triangles = reference::triangulated(polygon, nothing_forbidden);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(*triangles, (std::vector<scene::Triangle>{{5, 6, 8}, {6, 7, 8}}));
}

// The largest numbers that the grids allow: signs as in integers of any length.
TEST(Grid, DoesNotOverflow) {
  const std::int64_t u = scene::disk_unit;
  EXPECT_EQ(exact::in_circle({u, -u}, {u, u}, {-u, u}, {-u, -u}), 0);
  EXPECT_EQ(exact::in_circle({u, -u}, {u, u}, {-u, u}, {-u + 1, -u}), 1);
  EXPECT_EQ(exact::in_circle({u, -u}, {u, u}, {-u, u - 1}, {-u, -u}), -1);
  const exact::FlatPoint q{-exact::Wide{u} * scene::whole_weight, exact::Wide{u} * scene::whole_weight};
  EXPECT_GT(exact::orientation(DiskPoint{-u, -u}, DiskPoint{u, -u}, q), 0);
  const scene::Triangle t{0, 1, 2};
  EXPECT_EQ(exact::area_in(t, scene::at_vertex(0), scene::at_vertex(1), scene::at_vertex(2)), exact::Wide{1} << 120);
  EXPECT_EQ(exact::area_in(t, scene::at_vertex(1), scene::at_vertex(0), scene::at_vertex(2)), -(exact::Wide{1} << 120));
}

TEST(Flattening, AlwaysCertifiesSomething) {
  for (int n = 3; n < 12; ++n) {
    for (const bool closed : {true, false}) {
      auto mesh = fuzz::fan(n, closed);
      for (int how = 0; how < 3; ++how) {
        if (how == 1) mesh.points[1] = mesh.points[2];  // a sector without angle
        if (how == 2) mesh.points.assign(mesh.points.size(), {0, 0, 0});
        const reference::StarComplex complex(mesh);
        const reference::StarShape shape{closed ? scene::StarKind::interior : scene::StarKind::boundary,
                                         complex.ring(0), 0};
        const auto flat = reference::flattenings(shape, 0, exact::points_for_estimates(mesh));
        ASSERT_FALSE(flat.empty()) << n << closed << how;
        EXPECT_EQ(flat.size(), how == 0 ? 3U : 1U);
        for (const auto& f : flat) EXPECT_TRUE(reference::is_certified(shape, f));
      }
    }
  }
  const auto single = fuzz::fan(1, false);
  const reference::StarComplex complex(single);
  EXPECT_TRUE(reference::flattenings({scene::StarKind::boundary, complex.ring(0), 0}, 0, single.points).empty());
}

TEST(Flattening, IsNotCertifiedFoldedOrWoundTwice) {
  const auto mesh = fuzz::fan(6, true);
  const reference::StarComplex complex(mesh);
  const reference::StarShape shape{scene::StarKind::interior, complex.ring(0), 0};
  const std::vector<DiskPoint> once{{9, 0}, {5, 8}, {-5, 8}, {-9, 0}, {-5, -8}, {5, -8}};
  EXPECT_TRUE(reference::is_certified(shape, {once}));
  auto folded = once;
  std::swap(folded[1], folded[2]);
  EXPECT_FALSE(reference::is_certified(shape, {folded}));
  EXPECT_FALSE(
      reference::is_certified(shape, {{{9, 0}, {-5, 8}, {-5, -8}, {9, 1}, {-5, 9}, {-5, -9}}}));  // twice round
}

TEST(Weights, SumToOneAndKeepEdges) {
  const scene::Triangle t{7, 3, 5};
  const std::array<DiskPoint, 3> corners{DiskPoint{100, -3}, {1, 77}, {-90, -40}};
  const auto middle = reference::weights_in(t, corners, {});
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->weight[0] + middle->weight[1] + middle->weight[2], scene::whole_weight);
  EXPECT_EQ(middle->corner, (std::array<std::uint32_t, 3>{3, 5, 7}));
  const exact::FlatPoint on_edge{exact::Wide{101} * (scene::whole_weight / 2),
                                 exact::Wide{74} * (scene::whole_weight / 2)};
  const auto edge = reference::weights_in(t, corners, on_edge);
  ASSERT_TRUE(edge);
  EXPECT_EQ(*edge,
            (scene::CarrierPoint{{3, 7, scene::no_vertex}, {scene::whole_weight / 2, scene::whole_weight / 2, 0}}));
  EXPECT_FALSE(reference::weights_in(t, corners, {exact::Wide{1000} << 60, 0}));
}

}  // namespace
}  // namespace clues
