// D14: the last leg of a walk that comes out of a groove or a corner is no part of a sight line. It may leave the beam again that it comes into.
#include <gtest/gtest.h>

#include "reference/visibility/labels/walk.h"
#include "reference/visibility/search/fixpoint.h"
#include "tests/reference/support.h"

namespace clues::test {
namespace {

using exact::Point3;
using reference::Meets;

// Two plates over the cell. Between them a beam comes up: |x| < 5/2 at z = 1; beside it is umbra.
class LastLeg : public testing::Test {
 protected:
  LastLeg() {
    plates_.plate(-8, -8, -1, 8, 0);
    plates_.plate(1, -8, 8, 8, 0);
    plates_.plate(-20, -20, 20, 20, 3);  // wedges are looked for as far as the scene goes
    complex_ = exact::build_complex(plates_.mesh(), &cell_);
    scene_.emplace(complex_, cell_);
    reference::Statistics unused;
    wedges_.emplace(reference::find_wedges(*scene_, {}, unused).wedges);
    walker_.emplace(*scene_);
  }

  // Whether light is met on the way out of the dark, and whether that is in doubt.
  std::pair<Meets, bool> out_of_the_dark(const Point3& m, const Point3& p) const {
    const reference::Start start{p, std::nullopt, nullptr};
    reference::Walk walk;
    walk.legs.push_back({m, p, 0, true, true, false});
    EXPECT_EQ(walker_->visible(start, walk, *wedges_, 0), Meets::no) << "no sight line says so";
    return {walker_->visible_by_last_leg(start, walk, *wedges_, 0),
            walker_->last_leg_is_in_doubt(start, walk, *wedges_)};
  }

  SceneBuilder plates_;
  exact::ConvexCell cell_ = box_cell(-0.5, -0.5, -2, 0.5, 0.5, -1);
  exact::Complex complex_;
  std::optional<exact::SceneQuery> scene_;
  std::optional<reference::WedgeSet> wedges_;
  std::optional<reference::Walker> walker_;
};

TEST_F(LastLeg, StaysInTheDark) {
  EXPECT_EQ(out_of_the_dark(Point3(-5, 0.25, 1), Point3(-4, 0.125, 1)), std::pair(Meets::no, false));
}

TEST_F(LastLeg, EndsInABeam) {
  EXPECT_EQ(out_of_the_dark(Point3(-5, 0.25, 1), Point3(0.375, 0.125, 1)), std::pair(Meets::yes, false));
}

TEST_F(LastLeg, ThatLeavesABeamAgainIsInDoubt) {
  EXPECT_EQ(out_of_the_dark(Point3(-5, 0.25, 1), Point3(5, 0.125, 1)), std::pair(Meets::yes, true));
}

TEST_F(LastLeg, IsAskedOnlyAboutNewPiecesForLight) {
  const Point3 m(-5, 0.25, 1), p(0.375, 0.125, 1);
  reference::Walk walk;
  walk.legs.push_back({m, p, 0, true, false, true});
  const reference::Start start{p, std::nullopt, nullptr};
  EXPECT_EQ(walker_->visible_by_last_leg(start, walk, *wedges_, 0), Meets::yes);
  EXPECT_EQ(walker_->visible_by_last_leg(start, walk, *wedges_, wedges_->pieces().size()), Meets::no);
}

}  // namespace
}  // namespace clues::test
