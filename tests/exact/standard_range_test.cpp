// Scenes are moved into the range that engines compute in by a power of two, exactly or not at all.
#include "exact/cell/standard_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fuzz/generators/random.h"
#include "scene/messages/error.h"

namespace clues::exact {
namespace {

using scene::Point;

constexpr std::uint64_t kSeed = 20261123;
const std::vector<Point> kCell{{0, 0, 0}, {1, 0, 0}};

scene::TriangleMesh triangle(const Point& a, const Point& b, const Point& c) { return {{a, b, c}, {{0, 1, 2}}, {0}}; }

std::string refusal(const scene::TriangleMesh& mesh, const std::vector<Point>& cell) {
  try {
    StandardRange range(mesh, cell);
  } catch (const scene::Error& error) {
    EXPECT_EQ(error.code(), scene::ErrorCode::unsupported);
    return error.what();
  }
  return "";
}

TEST(StandardRange, LeavesScenesOfUsualSizeAlone) {
  for (const double size : {0x1p-64, 1e-9, 1.0, 3e7, 0x1.8p64}) {
    const auto mesh = triangle({size, 0, 5e-324}, {0, size, 0}, {0, 0, -size});
    EXPECT_FALSE(StandardRange(mesh, {{0, 0, 0}}).moves()) << size;
    EXPECT_FALSE(StandardRange(mesh, ConvexCell::from_doubles({{0, 0, 0}})).moves()) << size;
  }
  EXPECT_FALSE(StandardRange({}, std::vector<Point>{{0, 0, 0}}).moves());
}

TEST(StandardRange, MovesExactlyThereAndBack) {
  std::printf("seed %lu\n", kSeed);
  fuzz::Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const int power = random.between(-1074, 1000);
    scene::TriangleMesh mesh = triangle({}, {}, {});
    for (Point& p : mesh.points) {
      for (double& x : p) x = std::ldexp(random.between(-1000000, 1000000), power);
      for (double& x : p) x = std::isfinite(x) ? x : 0;
    }
    const StandardRange range(mesh, std::vector<Point>{mesh.points[0]});
    const scene::TriangleMesh moved = range.moved_in(mesh);
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 in = to_exact(moved.points[k]);
      EXPECT_EQ(range.moved_in(to_exact(mesh.points[k])), in);
      EXPECT_EQ(range.moved_back(in), to_exact(mesh.points[k])) << "2^" << power;
      EXPECT_EQ(range.estimate_moved_back(moved.points[k]), mesh.points[k]);
      for (const double x : moved.points[k]) largest = std::max(largest, std::fabs(x));
    }
    EXPECT_TRUE(!range.moves() || (largest >= 1 && largest < 2)) << "2^" << power;
  }
}

TEST(StandardRange, MovesPlanesAndCellsWithTheirOrientation) {
  const std::vector<Point> square{{0, 0x1p500, 0}, {0x1p500, 0x1p500, 0}, {0x1p500, 0, 0}, {0, 0, 0}};  // clockwise
  const ConvexCell cell = ConvexCell::from_doubles(square);
  const StandardRange range({}, cell);
  ASSERT_TRUE(range.moves());
  const ConvexCell moved = range.moved_in(cell);
  EXPECT_EQ(moved.vertices().back(), Point3(1, 1, 0));
  EXPECT_EQ(moved.facets().front().corners, cell.facets().front().corners);
  EXPECT_LT(moved.facets().front().plane.c(), 0);
  EXPECT_EQ(range.moved_back(Plane3(Point3(1, 1, 1), Point3(1, 2, 1), Point3(1, 1, 3))),
            Plane3(Point3(0x1p500, 0, 0), Point3(0x1p500, 1, 0), Point3(0x1p500, 0, 1)));
}

TEST(StandardRange, NamesTheVertexThatCannotBeMoved) {
  EXPECT_THAT(refusal(triangle({1e300, 0, 0}, {0, 1e-300, 0}, {0, 0, 1}), kCell),
              testing::AllOf(testing::StartsWith("vertex 1 has a coordinate 1e-300"),
                             testing::HasSubstr("vertex 0 has a coordinate 1e+300")));
  EXPECT_THAT(refusal(triangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), {{0, 0, 0}, {0, 5e-324, 1e300}}),
              testing::StartsWith("point of the cell 1 has a coordinate 5e-324"));
  // Not all of the way, but exactly.
  const auto mesh = triangle({0x1p1000, 0, 0}, {0, 0x1p-200, 0}, {0, 0, 1});
  const StandardRange range(mesh, kCell);
  EXPECT_EQ(range.moved_in(mesh).points, (std::vector<Point>{{0x1p126, 0, 0}, {0, 0x1p-1074, 0}, {0, 0, 0x1p-874}}));
  EXPECT_EQ(refusal(mesh, kCell), "");
}

TEST(StandardRange, VerticesThatNoTriangleUsesDoNotCount) {
  auto mesh = triangle({0x1p-900, 0, 0}, {0, 0x1p-901, 0}, {0, 0, 0x1p-902});
  mesh.points.push_back({std::numeric_limits<double>::max(), 1, 5e-324});
  const StandardRange range(mesh, std::vector<Point>{{0, 0, 0}});
  const auto moved = range.moved_in(mesh);
  EXPECT_EQ(moved.points[0], (Point{1, 0, 0}));
  EXPECT_TRUE(std::isfinite(moved.points[3][0]));
}

}  // namespace
}  // namespace clues::exact
