// D14: the last leg of a walk that comes out of a groove or a corner is no part of a sight line, nor is the way from a place beside a surface. They may leave the beam again that they come into.
#include <gtest/gtest.h>

#include "fastpath/visibility/labels/walker.h"
#include "fastpath/visibility/search/search.h"

namespace clues::fastpath {
namespace {

// Two plates over the cell. Between them a beam comes up: |x| < 5/2 at z = 1; beside it is umbra.
class LastLegFast : public testing::Test {
 protected:
  LastLegFast() {
    scene::TriangleMesh plates;
    std::vector<scene::Point> corners;  // of the cell
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        for (const double z : {-2., -1.}) corners.push_back({x, y, z});
      }
      const double near = 2 * x, far = 16 * x;
      const auto first = static_cast<std::uint32_t>(plates.points.size());
      for (const scene::Point& p : {scene::Point{near, -8, 0}, {far, -8, 0}, {far, 8, 0}, {near, 8, 0}})
        plates.points.push_back(p);
      plates.triangles.push_back({first, first + 1, first + 2});
      plates.triangles.push_back({first, first + 2, first + 3});
    }
    const exact::ConvexCell cell = exact::ConvexCell::from_doubles(corners);
    complex_ = exact::build_complex(plates, &cell);
    scene_.emplace(complex_, cell, cell);
    workers_.emplace(*scene_);
    search_.emplace(*scene_, bounds_, options_, counts_, *workers_);
    search_->run();
  }

  // Whether light is met on the way out of the dark, and whether that is in doubt.
  std::pair<Crossing, bool> out_of_the_dark(const Point& from, const Point& to) const {
    const ExactPoint m(from), p(to);
    Walk walk;
    walk.legs.push_back({&m, &p, nullptr, 0, 1, true, false});
    EXPECT_EQ(search_->walker().visible(walk, 0), Crossing::no) << "no sight line says so";
    return {search_->walker().visible_by_last_leg(walk, 0), search_->walker().last_leg_is_in_doubt(walk)};
  }

  const RoundedUp rounded_up_;
  const IntervalBox bounds_{Interval(-20, 20), Interval(-20, 20), Interval(-20, 20)};
  const LocalMapOptions options_;
  LocalMapCounts counts_;
  exact::Complex complex_;
  std::optional<LocalScene> scene_;
  std::optional<Workers> workers_;
  std::optional<Search> search_;
};

TEST_F(LastLegFast, StaysInTheDark) {
  EXPECT_EQ(out_of_the_dark({-5, 0.25, 1}, {-4, 0.125, 1}), std::pair(Crossing::no, false));
}

TEST_F(LastLegFast, EndsInABeam) {
  EXPECT_EQ(out_of_the_dark({-5, 0.25, 1}, {0.375, 0.125, 1}), std::pair(Crossing::yes, false));
}

TEST_F(LastLegFast, ThatLeavesABeamAgainIsInDoubt) {
  EXPECT_EQ(out_of_the_dark({-5, 0.25, 1}, {5, 0.125, 1}), std::pair(Crossing::yes, true));
}

// A walk goes on from a place beside a surface. If a piece that came later divides that from the point before, what follows says nothing about the start.
TEST_F(LastLegFast, APlaceInABeamSaysNothingOfAPointBeside) {
  const ExactPoint p(Point{5, 0.125, 1}), m(Point{6, 0.125, 1});
  const ExactPoint in_the_dark(Point{5.5, 0.125, 1}), in_the_beam(Point{0.375, 0.125, 1});
  Walk walk;
  walk.end = Walk::End::cell;
  walk.legs.push_back({&m, &p, &in_the_dark, 0, 1, false, false});
  EXPECT_EQ(search_->walker().visible(walk, 0), Crossing::yes);
  walk.legs[0].next = &in_the_beam;
  EXPECT_EQ(search_->walker().visible(walk, 0), Crossing::touch);
}

}  // namespace
}  // namespace clues::fastpath
