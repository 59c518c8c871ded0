// Exact planar sets: what the bounds of a refinement are made of.
#include "reference/visibility/planar/flat_set.h"

#include <gtest/gtest.h>

#include <array>

namespace clues::test {
namespace {

using exact::FT;
using exact::Point2;
using reference::Face2;
using reference::FlatSet;
using reference::Ring2;

constexpr int kTwiceTriangle = 400;  // some triangle that holds all the squares

Ring2 square(int x0, int y0, int x1, int y1) {
  return {Point2(x0, y0), Point2(x1, y0), Point2(x1, y1), Point2(x0, y1)};
}

FlatSet set_of(const std::vector<Face2>& faces) { return FlatSet(FT(kTwiceTriangle), faces); }
FT twice_area(const FlatSet& set) { return set.fraction() * FT(kTwiceTriangle); }

TEST(FlatSet, FacesWithACommonBorderBecomeOne) {
  const FlatSet set = set_of({{square(0, 0, 1, 2)}, {square(1, 0, 3, 2)}});
  ASSERT_EQ(set.faces().size(), 1U);
  EXPECT_EQ(set.faces()[0].size(), 1U);
  EXPECT_EQ(set.faces()[0][0].size(), 4U) << "corners in the middle of a straight border go";
  EXPECT_EQ(twice_area(set), FT(12));
}

TEST(FlatSet, UnionIntersectionAndDifferenceOfSquares) {
  const FlatSet a = set_of({{square(0, 0, 4, 4)}}), b = set_of({{square(2, 2, 6, 6)}});
  EXPECT_EQ(twice_area(unite(a, b)), FT(2 * 28));
  EXPECT_EQ(twice_area(intersect(a, b)), FT(2 * 4));
  EXPECT_EQ(twice_area(subtract(a, b)), FT(2 * 12));
}

TEST(FlatSet, HolesAreKept) {
  const FlatSet ring = subtract(set_of({{square(0, 0, 6, 6)}}), set_of({{square(2, 2, 4, 4)}}));
  ASSERT_EQ(ring.faces().size(), 1U);
  EXPECT_EQ(ring.faces()[0].size(), 2U);
  EXPECT_EQ(twice_area(ring), FT(2 * 32));
  EXPECT_EQ(twice_area(unite(ring, set_of({{square(1, 1, 5, 5)}}))), FT(2 * 36));
  EXPECT_TRUE(intersect(ring, set_of({{square(2, 2, 4, 4)}})).empty()) << "a common border is no area";
}

TEST(FlatSet, WhatIsTakenAwayWhollyLeavesNothing) {
  const FlatSet a = set_of({{square(0, 0, 4, 4)}}), none(FT{kTwiceTriangle});
  EXPECT_TRUE(subtract(a, a).empty());
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(twice_area(subtract(a, none)), FT(32));
  EXPECT_EQ(twice_area(unite(none, a)), FT(32));
  EXPECT_TRUE(intersect(none, a).empty());
}

TEST(FlatSet, BordersThatOverlapInPart) {
  const FlatSet a = set_of({{square(0, 0, 4, 2)}}), b = set_of({{square(1, 2, 9, 3)}});
  EXPECT_EQ(twice_area(unite(a, b)), FT(2 * 16));
  ASSERT_EQ(unite(a, b).faces().size(), 1U);
  EXPECT_EQ(unite(a, b).faces()[0][0].size(), 8U);
  EXPECT_TRUE(intersect(a, b).empty());
}

TEST(FlatSet, PartsThatTouchInACornerStayApart) {
  const FlatSet both = unite(set_of({{square(0, 0, 1, 1)}}), set_of({{square(1, 1, 2, 2)}}));
  EXPECT_EQ(both.faces().size(), 2U);
  EXPECT_EQ(twice_area(both), FT(4));
}

}  // namespace
}  // namespace clues::test
