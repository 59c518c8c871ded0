// Which pieces of a round are a part of one of the round before: only such may go without being asked about again.
#include "fastpath/visibility/search/pieces_before.h"

#include <gtest/gtest.h>

#include <array>

namespace clues::fastpath {
namespace {

class PiecesBeforeTest : public ::testing::Test {
 protected:
  PiecesBeforeTest() { on_.plane = other_.plane = &plane_, on_.center = other_.center = &points_[0]; }

  // Between rays 1 to 5, which turn to the left.
  ValidPiece piece(std::size_t ray0, std::size_t ray1, int blocker = -1) const {
    ValidPiece p;
    p.on = &on_;
    p.ray0 = &points_[ray0];
    p.ray1 = &points_[ray1];
    p.blocker = blocker;
    return p;
  }
  std::size_t others(const ValidPiece& p) const {
    const RoundedUp rounded_up;
    return before_.others({p}).size();
  }

  const std::array<ExactPoint, 6> points_{ExactPoint(Point{0, 0, 0}), ExactPoint(Point{4, 0, 0}),
                                          ExactPoint(Point{4, 1, 0}), ExactPoint(Point{4, 2, 0}),
                                          ExactPoint(Point{4, 3, 0}), ExactPoint(Point{4, 4, 0})};
  const Plane plane_{points_[0], points_[1], points_[5]};
  OnWedge on_, other_;
  PiecesBefore before_;
};

TEST_F(PiecesBeforeTest, HoldTheirPartsAndNothingElse) {
  EXPECT_TRUE(before_.replace({piece(2, 4), piece(1, 2, 7)}));
  for (const ValidPiece& part : {piece(2, 4), piece(2, 3), piece(3, 4)}) EXPECT_EQ(others(part), 0U);
  for (const ValidPiece& wider : {piece(1, 4), piece(2, 5), piece(1, 5), piece(1, 3), piece(3, 5), piece(4, 5)})
    EXPECT_EQ(others(wider), 1U);
  EXPECT_EQ(others(piece(1, 2, 7)), 0U);
  EXPECT_EQ(others(piece(2, 4, 7)), 1U) << "what ends it is another one";
}

TEST_F(PiecesBeforeTest, AreOfOneWedgeAndNearEdge) {
  before_.replace({piece(1, 5)});
  ValidPiece elsewhere = piece(2, 3), nearer = piece(2, 3);
  elsewhere.on = &other_;
  nearer.near0 = &points_[1];
  nearer.near1 = &points_[5];
  EXPECT_EQ(others(elsewhere), 1U);
  EXPECT_EQ(others(nearer), 1U);
}

// A ray is a direction: another point of it says the same.
TEST_F(PiecesBeforeTest, KnowRaysByAnyOfTheirPoints) {
  const ExactPoint twice(Point{8, 2, 0});
  before_.replace({piece(2, 4)});
  ValidPiece part = piece(2, 3);
  part.ray0 = &twice;
  EXPECT_EQ(others(part), 0U);
}

TEST_F(PiecesBeforeTest, SayWhetherAllAreStillThere) {
  EXPECT_TRUE(before_.replace({piece(1, 2), piece(2, 3)}));
  EXPECT_TRUE(before_.replace({piece(2, 3), piece(3, 4), piece(1, 2)}));
  EXPECT_FALSE(before_.replace({piece(1, 3), piece(3, 4)})) << "a part of one is not that one";
  EXPECT_FALSE(before_.replace({}));
  EXPECT_TRUE(before_.replace({}));
}

}  // namespace
}  // namespace clues::fastpath
