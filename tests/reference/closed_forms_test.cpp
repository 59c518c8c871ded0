// D8-D15 against areas derived by hand. In each scene the receiver is a plate facing down at z = 2 (or as said), the cell a square of the plane
// z = 0, so that a point p of the receiver is hidden by a plate at z = 1 exactly when (p + v) / 2 lies in the plate for every v of the cell.
#include <gtest/gtest.h>

#include "support.h"

namespace clues::test {
namespace {

using exact::FT;

constexpr bool kDown = false;  // plates face up; the cell below looks at their backs

exact::ConvexCell square(double r) { return box_cell(-r, -r, 0, r, r, 0); }

FT hidden_on(const SceneBuilder& scene, const exact::ConvexCell& cell, std::uint32_t receiver) {
  const auto map = map_of(scene.mesh(), cell);
  EXPECT_EQ(map.statistics.walk_disagreements, 0U);
  EXPECT_EQ(map.statistics.conservative_fallbacks, 0U);
  return hidden_area(map, scene.mesh(), receiver, 2, kDown);
}

TEST(ClosedForm, OneTriangle) {
  // 2T = (-8,-8) (8,-8) (0,8), moved inwards by the square: y >= -7, 2|x| + y <= 8 - 3. A triangle of base 12 and height 12.
  SceneBuilder s;
  s.triangle({-4, -4, 1}, {4, -4, 1}, {0, 4, 1});
  EXPECT_EQ(hidden_on(s, square(1), s.plate(-10, -10, 10, 10, 2)), FT(72));
}

TEST(ClosedForm, OnePlateAndABoxCell) {
  // From z = 0: |x| + 1 <= 4. From z = -1: (2|x| + 1) / 3 <= 2, so |x| <= 5/2.
  SceneBuilder s;
  s.plate(-2, -2, 2, 2, 1);
  EXPECT_EQ(hidden_on(s, box_cell(-1, -1, -1, 1, 1, 0), s.plate(-10, -10, 10, 10, 2)), FT(25));
}

TEST(ClosedForm, OneBoxBeforeAWall) {
  // The box is [-2,2]^2 x [1, 3/2]. At z = 2 its lower face hides |x| <= 3 and its upper face |x| <= (2 - 1/4) * 4/3 = 7/3; the hull of the box
  // hides no more than the union of sections seen from one v does, and for the square cell that is the lower face's shadow.
  SceneBuilder s;
  s.box({-2, -2, 1}, {2, 2, 1.5});
  EXPECT_EQ(hidden_on(s, square(1), s.plate(-10, -10, 10, 10, 2)), FT(36));
}

TEST(ClosedForm, Window) {
  // A wall with the hole [-1,1]^2: the receiver is seen for |x|, |y| < 2 * 1 + 1.
  SceneBuilder s;
  s.plate(-30, -30, 30, -1, 1);
  s.plate(-30, 1, 30, 30, 1);
  s.plate(-30, -1, -1, 1, 1);
  s.plate(1, -1, 30, 1, 1);
  EXPECT_EQ(hidden_on(s, square(1), s.plate(-10, -10, 10, 10, 2)), FT(400 - 36));
}

TEST(ClosedForm, TwoHalfWallsFuse) {
  // A = [-3,1/2] x [-3,3] at z = 1 and B = [-1/2,3] x [-3,3] at z = 3/2; the receiver is at z = 3. A alone hides x in [-7,-1/2], |y| <= 7,
  // B alone x in [0,5], |y| <= 5. Between them no line of sight passes: a line right of A and left of B meets z = 0 at x > 5/2. So
  // x in [-1/2,0], |y| <= 5 is hidden by both together: 91 + 50 + 5.
  SceneBuilder s;
  s.plate(-3, -3, 0.5, 3, 1);
  s.plate(-0.5, -3, 3, 3, 1.5);
  EXPECT_EQ(hidden_on(s, square(1), s.plate(-10, -10, 10, 10, 3)), FT(146));
}

TEST(ClosedForm, LShapeInsideCorner) {
  // The plate [-4,4]^2 without its quadrant x, y > 0. Hidden: [-7,7]^2 but not x, y > -1.
  SceneBuilder s;
  s.plate(-4, -4, 0, 4, 1);
  s.plate(0, -4, 4, 0, 1);
  EXPECT_EQ(hidden_on(s, square(1), s.plate(-10, -10, 10, 10, 2)), FT(196 - 64));
}

TEST(ClosedForm, LShapeSeenFromADiamond) {
  // The cell is |x| + |y| <= 2: hidden is |x|, |y| <= 6 with x <= -2, y <= -2 or x + y <= -2. The slanted border is an SE-MV wedge of the
  // inside corner.
  SceneBuilder s;
  s.plate(-4, -4, 0, 4, 1);
  s.plate(0, -4, 4, 0, 1);
  const std::uint32_t receiver = s.plate(-10, -10, 10, 10, 2);
  const auto cell = exact::ConvexCell::from_doubles({{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}});
  const auto map = map_of(s.mesh(), cell);
  EXPECT_EQ(hidden_area(map, s.mesh(), receiver, 2, kDown), FT(144 - 62));
  EXPECT_GT(map.statistics.inside_corners, 0U);
}

TEST(ClosedForm, UmbraWithAnApex) {
  // The cell [-4,4]^2 is larger than the plate [-1,1]^2: at height z the umbra is |x| <= 4 - 3z, which ends at z = 4/3.
  const auto hidden_at = [](double z) {
    SceneBuilder s;
    s.plate(-1, -1, 1, 1, 1);
    return hidden_on(s, square(4), s.plate(-10, -10, 10, 10, z));
  };
  EXPECT_EQ(hidden_at(1.25), FT(1) / FT(4));
  EXPECT_EQ(hidden_at(1.3125), FT(1) / FT(64));
  EXPECT_EQ(hidden_at(1.375), FT(0));
}

TEST(ClosedForm, InsideAClosedRoomNothingInFrontIsHidden) {
  SceneBuilder s;
  s.box({-8, -8, -8}, {8, 8, 8});
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -1, 1, 1, 1));
  EXPECT_EQ(map.visible.size(), 12U);
  for (const auto& r : map.regions) EXPECT_EQ(r.visible, !r.front);  // the inner sides are the backs
}

TEST(ClosedForm, BehindAClosedRoomAllIsHidden) {
  SceneBuilder s;
  s.box({-8, -8, -8}, {8, 8, 8});
  s.box({10, -1, -1}, {12, 1, 1});
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -1, 1, 1, 1));
  EXPECT_EQ(map.visible.size(), 12U);
}

TEST(ClosedForm, ATriangleThatMeetsTheCellIsVisible) {
  SceneBuilder s;
  s.triangle({0, 0, 0}, {5, 0, 0}, {0, 5, 0});     // through the cell
  s.triangle({1, -1, -1}, {1, 1, -1}, {1, 0, 1});  // touches its face x = 1
  const auto map = map_of(s.mesh(), box_cell(-1, -1, -1, 1, 1, 1));
  EXPECT_EQ(map.visible, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ClosedForm, SolidModeSeesFrontsOnlyAndRefusesOpenMeshes) {
  SceneBuilder s;
  s.box({-2, -2, 2}, {2, 2, 3});
  reference::Options solid;
  solid.mode = reference::Mode::solid;
  const auto map = map_of(s.mesh(), square(1), solid);
  EXPECT_EQ(map.visible, (std::vector<std::uint32_t>{0, 1}));  // the lower face
  for (const auto& r : map.regions) EXPECT_TRUE(r.front);
  s.plate(-5, -5, 5, 5, 8);
  EXPECT_THROW(map_of(s.mesh(), square(1), solid), std::exception);
}

}  // namespace
}  // namespace clues::test
