// What is next to a part of a mesh (closure/neighbours.h).
#include "fastpath/visibility/closure/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fuzz/generators/parts.h"
#include "scene/mesh/mesh.h"

namespace clues::tests {
namespace {

using Ids = std::vector<std::uint32_t>;

// A cube from -1 to 1, two triangles a side: 0 and 1 at the bottom, 2 and 3 on top, then y = -1, y = 1, x = -1, x = 1.
scene::TriangleMesh cube() { return fuzz::closed_box({-1, -1, -1}, {1, 1, 1}); }

TEST(Neighbours, HaveTwoCornersInCommon) {
  const Ids bottom{0, 1};
  const Ids around = fastpath::neighbours_of(cube(), bottom);
  EXPECT_EQ(around, (Ids{4, 7, 9, 10})) << "of each side the triangle with the whole edge";
  EXPECT_TRUE(fastpath::neighbours_of(cube(), {}).empty());
}

TEST(Neighbours, InSightGoOnWhereTheOtherEnds) {
  const Ids left{8, 9};  // x = -1
  const auto seen_from = [&](const scene::Point& eye) { return fastpath::neighbours_in_sight(cube(), left, eye); };
  const auto of_plane = [](const Ids& ids, std::uint32_t first) {
    return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t t) { return t / 2 == first / 2; });
  };
  const Ids from_aside = seen_from({-5, -5, 0});  // y = -1 is seen, too; what is behind the left side is not
  EXPECT_TRUE(of_plane(from_aside, 4));
  for (const std::uint32_t hidden : {0U, 2U, 6U}) EXPECT_FALSE(of_plane(from_aside, hidden)) << hidden;
  EXPECT_TRUE(seen_from({-5, 0, 0}).empty());
  EXPECT_EQ(seen_from({0, 0, 0}), fastpath::neighbours_of(cube(), left)) << "in a room all are";
}

// Without a number that is wrong: whose third corner is in the plane of edge and eye counts as in sight of any.
TEST(Neighbours, KnowNothingOfWhatIsEdgeOn) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  const Ids first{0};
  EXPECT_EQ(fastpath::neighbours_in_sight(mesh, first, {5, 5, 0}), Ids{1});
  EXPECT_EQ(fastpath::neighbours_in_sight(mesh, first, {5, 5, 1}), Ids{1});
}

}  // namespace
}  // namespace clues::tests
