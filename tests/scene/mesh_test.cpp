// D1: a triangle without area is found exactly, however near to one it is and at any scale.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "scene/mesh/mesh.h"

namespace clues::tests {
namespace {

using scene::Point;
using scene::TriangleMesh;
using testing::ElementsAre;

bool is_degenerate(const Point& a, const Point& b, const Point& c) {
  const TriangleMesh mesh{{a, b, c}, {{0, 1, 2}}, {0}};
  return !scene::degenerate_triangles(mesh).empty();
}

TEST(Degenerate, IdsAreKeptAndAscending) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}},
                          {{0, 0, 1}, {0, 1, 2}, {0, 1, 3}, {2, 2, 2}, {1, 2, 3}},
                          {0, 1, 2, 3, 4}};
  EXPECT_THAT(scene::degenerate_triangles(mesh), ElementsAre(0, 2, 3));
}

TEST(Degenerate, OneUnitInTheLastPlaceIsArea) {
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(is_degenerate({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  EXPECT_FALSE(is_degenerate({0, 0, 0}, {1, 1, next}, {3, 3, 3}));
  // 3 * 0.1 is not 0.3 in doubles, so these corners are not collinear.
  EXPECT_FALSE(is_degenerate({0, 0, 0}, {0.1, 1, 0}, {0.3, 3, 0}));
}

TEST(Degenerate, UnderflowAndOverflowDoNotDecide) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(is_degenerate({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}));
  EXPECT_TRUE(is_degenerate({0, 0, 0}, {tiny, tiny, 0}, {3 * tiny, 3 * tiny, 0}));
  EXPECT_FALSE(is_degenerate({-huge, -huge, 0}, {huge, huge, 0}, {0, tiny, 0}));
  EXPECT_TRUE(is_degenerate({-huge, -huge, 0}, {huge, huge, 0}, {tiny, tiny, 0}));
  EXPECT_TRUE(is_degenerate({0, -0.0, 0}, {-0.0, 0, 0}, {1, 2, 3}));
}

}  // namespace
}  // namespace clues::tests
