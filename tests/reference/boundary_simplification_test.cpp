// Simpler borders of flat hidden regions, in closed form. Each outcome is also held against the old region as an exact set. The literal readings (hazards)
// are in tests/planted.
#include "reference/visibility/hidden/boundary_simplification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "flat_regions.h"

namespace clues::test {
namespace {

using exact::FT;
using exact::Point2;
using reference::Face2;
using reference::FlatSet;
using reference::Ring2;
using reference::simplified;

const FT kAll(200 * 200);  // more than any region can lose
const Face2 chamfered = chamfered_square();

FT twice_area(const FlatSet& set) { return set.fraction() * FT(200 * 200); }
std::size_t segments(const Face2& face) { return reference::boundary_segments(face, outline()); }

// Simplified, with what holds of every simplification.
Face2 simpler(const Face2& face, const FT& budget) {
  const Face2 out = simplified(face, outline(), budget);
  EXPECT_TRUE(inside(out, face));
  EXPECT_EQ(out.size(), face.size()) << "no hole comes or goes";
  EXPECT_LE(segments(out), segments(face));
  EXPECT_LE(twice_area(set_of(face)) - twice_area(set_of(out)), budget);
  return out;
}

TEST(BoundarySimplification, AChordCutsTheCornerThatLosesLeastAndTiesGoByPosition) {
  EXPECT_EQ(simpler(chamfered, FT(18)), chamfered);  // either corner of the chamfer costs 19
  EXPECT_EQ(sorted(simpler(chamfered, FT(19))[0]), sorted(ring({{10, 10}, {30, 10}, {29, 30}, {10, 30}})));
}

TEST(BoundarySimplification, WhereARingBeginsDoesNotMatter) {
  const std::vector<Point2> expected = sorted(simpler(chamfered, FT(19))[0]);
  Face2 turned = chamfered;
  for (std::size_t i = 0; i < 5; ++i) {
    std::rotate(turned[0].begin(), turned[0].begin() + 1, turned[0].end());
    EXPECT_EQ(sorted(simpler(turned, FT(19))[0]), expected);
  }
}

TEST(BoundarySimplification, AHoleGrowsToWhereItsSidesMeet) {
  const Face2 face{ring({{5, 5}, {90, 5}, {5, 90}}), ring({{10, 10}, {10, 30}, {29, 30}, {30, 29}, {30, 10}})};
  EXPECT_EQ(simpler(face, FT(0)), face);
  const Face2 out = simpler(face, FT(1));
  EXPECT_EQ(sorted(out[1]), sorted(ring({{10, 10}, {10, 30}, {30, 30}, {30, 10}})));
  EXPECT_EQ(out[0], face[0]);
}

// A dent (both corners reflex) and a step (one reflex, one not).
TEST(BoundarySimplification, NeighboursOfADroppedSegmentAreExtendedIntoTheRegion) {
  const Face2 dent{ring({{10, 10}, {20, 10}, {24, 14}, {26, 14}, {30, 10}, {40, 10}, {40, 40}, {10, 40}})};
  EXPECT_EQ(sorted(simpler(dent, FT(2))[0]),
            sorted(ring({{10, 10}, {20, 10}, {25, 15}, {30, 10}, {40, 10}, {40, 40}, {10, 40}})));
  const Face2 step{ring({{10, 10}, {30, 10}, {30, 30}, {29, 30}, {29, 50}, {10, 50}})};
  const Face2 stepless = simpler(step, FT(40));
  EXPECT_EQ(stepless[0].size(), 4U);
  EXPECT_EQ(twice_area(set_of(step)) - twice_area(set_of(stepless)), FT(40));  // the strip 1 x 20 that sticks out
}

TEST(BoundarySimplification, CornersThatBecomeStraightGoForNothing) {
  const Face2 bump{ring({{10, 10}, {50, 10}, {50, 30}, {52, 35}, {50, 40}, {50, 60}, {10, 60}})};
  EXPECT_EQ(simpler(bump, FT(19)), bump);
  EXPECT_EQ(sorted(simpler(bump, FT(20))[0]), sorted(ring({{10, 10}, {50, 10}, {50, 60}, {10, 60}})));
}

TEST(BoundarySimplification, AContourOfThreeSegmentsStaysAndSoDoesAHoleOfThree) {
  const Face2 three{ring({{10, 10}, {30, 10}, {10, 30}})};
  EXPECT_EQ(simpler(three, kAll), three);
  const Face2 holed{ring({{5, 5}, {90, 5}, {5, 90}}), ring({{10, 10}, {10, 30}, {30, 10}})};
  EXPECT_EQ(simpler(holed, kAll), holed);
  EXPECT_EQ(simpler(chamfered, kAll)[0].size(), 3U);
}

TEST(BoundarySimplification, AWhollyHiddenTriangleHasNothingToSimplify) {
  const Face2 whole{ring({{0, 0}, {200, 0}, {0, 200}})};
  EXPECT_EQ(segments(whole), 0U);
  EXPECT_EQ(simpler(whole, kAll), whole);
}

TEST(BoundarySimplification, WhatLiesOnTheOutlineStays) {
  const Face2 face{ring({{0, 10}, {20, 12}, {30, 20}, {31, 30}, {20, 45}, {0, 50}})};
  const Face2 out = simpler(face, kAll);
  EXPECT_EQ(sorted(out[0]).front(), Point2(0, 10));
  EXPECT_EQ(sorted(out[0])[1], Point2(0, 50));
  EXPECT_EQ(segments(face), 5U);
  EXPECT_EQ(segments(out), 2U);
  const Face2 corner{ring({{0, 0}, {40, 0}, {20, 10}, {10, 20}, {0, 40}})};  // around the triangle's corner
  const Face2 cut = simpler(corner, kAll);
  EXPECT_EQ(segments(cut), 2U) << "one segment would run through what is visible";
  for (const Point2& p : ring({{0, 0}, {40, 0}, {0, 40}})) EXPECT_EQ(std::count(cut[0].begin(), cut[0].end(), p), 1);
}

// A hole that touches the outer border in a corner, and two parts that hang together in one: rings that touch themselves.
TEST(BoundarySimplification, APinchIsNotCutOpen) {
  const FlatSet square = set_of({ring({{10, 10}, {50, 10}, {50, 50}, {10, 50}})});
  const FlatSet touching = subtract(square, set_of({ring({{50, 30}, {40, 36}, {30, 30}, {40, 25}})}));
  ASSERT_EQ(touching.faces().size(), 1U);
  const FlatSet inner = subtract(subtract(square, set_of({ring({{20, 20}, {30, 20}, {30, 30}, {20, 31}})})),
                                 set_of({ring({{30, 30}, {40, 30}, {40, 41}, {30, 40}})}));
  ASSERT_EQ(inner.faces().size(), 1U);
  for (const FlatSet& set : {touching, inner}) {
    const Face2 face = set.faces()[0];
    for (const int budget : {0, 20, 60, 200, 800, 40000}) {
      const Face2 out = simpler(face, FT(budget));
      EXPECT_EQ(set_of(out).faces().size(), 1U);
    }
  }
}

// A spike that touches the opposite side of the hole it is in: that side goes straight on there, and must keep the corner.
TEST(BoundarySimplification, ACornerThatIsTouchedStays) {
  const FlatSet square = set_of({ring({{10, 10}, {60, 10}, {60, 60}, {10, 60}})});
  const FlatSet set = subtract(subtract(square, set_of({ring({{20, 20}, {40, 20}, {40, 30}, {20, 25}})})),
                               set_of({ring({{20, 35}, {40, 30}, {40, 40}, {20, 40}})}));
  ASSERT_EQ(set.faces().size(), 1U);
  const Face2 face = set.faces()[0];
  EXPECT_EQ(simpler(face, FT(0)), face);
}

TEST(BoundarySimplification, ADartGoesOnAlongItsOwnSides) {
  const Face2 dart{ring({{10, 10}, {50, 10}, {50, 50}, {40, 20}})};
  EXPECT_EQ(simpler(dart, FT(266)), dart);
  const Face2 out = simpler(dart, FT(267));  // either side of the reflex corner, extended: 800/3
  EXPECT_EQ(out[0].size(), 3U);
  EXPECT_EQ(twice_area(set_of(dart)) - twice_area(set_of(out)), FT(800) / FT(3));
  EXPECT_EQ(std::count(out[0].begin(), out[0].end(), Point2(FT(110) / FT(3), FT(10))), 1);
}

TEST(BoundarySimplification, WhatStandsInATriangleIsNotCutOff) {
  // Three corners of the four would go for chords, were the hole not in the triangles that they give up.
  const Face2 face{ring({{10, 10}, {40, 10}, {40, 40}, {10, 41}}), ring({{30, 20}, {29, 21}, {30, 22}})};
  EXPECT_EQ(sorted(simpler(face, kAll)[0]), sorted(ring({{10, 10}, {40, 10}, {40, 40}})));
}

TEST(BoundarySimplification, MoreLossContinuesWhatLessBegan) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Face2 face = set_of(star(seed)).faces()[0];
    Face2 last = face;
    for (const int percent : {1, 2, 5, 10, 20, 50, 100}) {
      const Face2 out = simpler(face, FT(percent) * twice_area(set_of(face)) / FT(100));
      EXPECT_TRUE(inside(out, last));
      EXPECT_LE(segments(out), segments(last));
      last = out;
    }
    EXPECT_EQ(segments(last), 3U);
  }
}

}  // namespace
}  // namespace clues::test
