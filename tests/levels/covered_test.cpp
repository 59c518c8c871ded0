// Which sides of hulls are left out. Every one may be; what is tested is that lists hardly grow: what is open, but for a little, stays.
#include "scene/levels/bsp_covered.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace clues::tests {
namespace {

using scene::Hull;
using scene::Point;
using Covered = std::vector<bool>;

// Sides in the order: low x, high x, low y, high y, low z, high z.
Hull box(const Point& low, const Point& high) {
  Hull hull;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double at : {low[axis], high[axis]}) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      auto& face = hull.emplace_back();
      for (const auto& [at_u, at_v] :
           {std::pair{low[u], low[v]}, {high[u], low[v]}, {high[u], high[v]}, {low[u], high[v]}}) {
        Point p{};
        p[axis] = at;
        p[u] = at_u;
        p[v] = at_v;
        face.push_back(p);
      }
    }
  }
  return hull;
}

std::vector<std::array<Point, 3>> drawn_on_top(double x0, double x1, double y0, double y1, double z) {
  return {{{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}}}, {{{x0, y0, z}, {x1, y1, z}, {x0, y1, z}}}};
}

TEST(CoveredSides, OnesThatAreDrawnAllOver) {
  const std::vector<Hull> hulls{box({0, 0, 0}, {64, 64, 16})};
  EXPECT_EQ(scene::covered_faces(hulls, drawn_on_top(0, 64, 0, 64, 16))[0], Covered({0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(scene::covered_faces(hulls, drawn_on_top(-8, 99, -8, 99, 16.25))[0], Covered({0, 0, 0, 0, 0, 1}))
      << "near enough";
  EXPECT_EQ(scene::covered_faces(hulls, drawn_on_top(0, 62, 0, 64, 16))[0], Covered(6)) << "a strip is open";
  EXPECT_EQ(scene::covered_faces(hulls, drawn_on_top(0, 64, 0, 64, 17))[0], Covered(6)) << "one can look in between";
  EXPECT_EQ(scene::covered_faces(hulls, {})[0], Covered(6));
}

// A slit beside a drawing, or a hole in it.
TEST(CoveredSides, OnesOfWhichLittleIsOpen) {
  const std::vector<Hull> large{box({0, 0, 0}, {64, 64, 16})}, small{box({0, 0, 0}, {16, 16, 16})};
  EXPECT_EQ(scene::covered_faces(large, drawn_on_top(0, 63.5, 0, 64, 16))[0], Covered({0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(scene::covered_faces(large, drawn_on_top(0, 62.5, 0, 64, 16))[0], Covered(6)) << "96 square units";
  EXPECT_EQ(scene::covered_faces(small, drawn_on_top(0, 15, 0, 16, 16))[0], Covered({0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(scene::covered_faces(small, drawn_on_top(0, 14, 0, 16, 16))[0], Covered(6)) << "an eighth of it";
}

TEST(CoveredSides, OnesThatOtherHullsStandOn) {
  const auto covered = scene::covered_faces({box({0, 0, 0}, {64, 64, 16}), box({0, 0, 16}, {64, 64, 80})}, {});
  EXPECT_EQ(covered[0], Covered({0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(covered[1], Covered({0, 0, 0, 0, 1, 0}));
  const auto smaller = scene::covered_faces({box({0, 0, 0}, {64, 64, 16}), box({8, 8, 16}, {24, 24, 80})}, {});
  EXPECT_EQ(smaller[0], Covered(6)) << "the smaller one stands on a part of it";
  EXPECT_EQ(smaller[1], Covered({0, 0, 0, 0, 1, 0}));
  auto drawn = drawn_on_top(0, 64, 0, 8, 16);
  for (const auto& t : drawn_on_top(0, 64, 8, 64, 16)) drawn.push_back(t);
  EXPECT_EQ(scene::covered_faces({box({0, 0, 0}, {64, 64, 16}), box({8, 8, 16}, {24, 24, 80})}, drawn)[0],
            Covered({0, 0, 0, 0, 0, 1}));
}

// Two hulls that are the same would each be covered by the other, and both be gone.
TEST(CoveredSides, TwinsAndNestedOnesStay) {
  const auto twins = scene::covered_faces({box({0, 0, 0}, {64, 64, 16}), box({0, 0, 0}, {64, 64, 16})}, {});
  EXPECT_EQ(twins[0], Covered(6));
  EXPECT_EQ(twins[1], Covered(6));
  const auto flush = scene::covered_faces({box({0, 0, 0}, {64, 64, 16}), box({32, 0, 0}, {96, 64, 16})}, {});
  EXPECT_EQ(flush[0], Covered({0, 1, 0, 0, 0, 0})) << "its end is in the other";
  EXPECT_EQ(flush[1], Covered({1, 0, 0, 0, 0, 0}));
  const auto nested = scene::covered_faces({box({0, 0, 0}, {64, 64, 64}), box({8, 8, 8}, {16, 16, 16})}, {});
  EXPECT_EQ(nested[0], Covered(6));
  EXPECT_EQ(nested[1], Covered(6, true));
}

}  // namespace
}  // namespace clues::tests
