// D24 in exact numbers: scene P of two cells side by side below a plate, and what must hold between any two cells.
#include <gtest/gtest.h>

#include <map>

#include "reference/delta/delta.h"
#include "sewn_checks.h"
#include "tests/reference/support.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::SeenFrom;

// A plate below a large receiver, and two cells that are mirror images at x = 0.
struct SceneP {
  SceneBuilder scene;
  std::uint32_t receiver;
  exact::ConvexCell a = box_cell(-2, -1, -1, 0, 1, 0), b = box_cell(0, -1, -1, 2, 1, 0);
  SceneP() {
    scene.plate(-1, -1, 1, 1, 4);
    receiver = scene.plate(-20, -20, 20, 20, 8);
  }
};

// Of the receiver's lower side, by label; its two triangles have an area of 800 each.
std::map<SeenFrom, FT> areas_on_receiver(const reference::Delta& delta, std::uint32_t receiver) {
  std::map<SeenFrom, FT> areas;
  for (const SeenFrom seen : {SeenFrom::neither, SeenFrom::from, SeenFrom::to, SeenFrom::both}) areas[seen] = FT(0);
  for (const auto& r : delta.regions) {
    if (r.side.triangle >= receiver && !r.side.front) areas[r.seen] += FT(800) * r.area_fraction;
  }
  return areas;
}

TEST(Delta, ScenePHasItsExactAreas) {
  const SceneP p;
  const auto ab = reference::delta_of(p.scene.mesh(), p.a, p.b, {});
  const auto ba = reference::delta_of(p.scene.mesh(), p.b, p.a, {});
  auto there = areas_on_receiver(ab, p.receiver), back = areas_on_receiver(ba, p.receiver);
  EXPECT_EQ(there[SeenFrom::from], FT(18) / 5);  // DR_O(AB)
  EXPECT_EQ(there[SeenFrom::to], FT(18) / 5);    // DR_E(AB)
  EXPECT_EQ(back[SeenFrom::from], FT(18) / 5);
  EXPECT_EQ(back[SeenFrom::to], FT(18) / 5);
  EXPECT_EQ(there[SeenFrom::neither], FT(0));
  EXPECT_EQ(there[SeenFrom::from] + there[SeenFrom::to] + there[SeenFrom::both], FT(1600));
  EXPECT_TRUE(ab.packets.plus.empty());  // the same triangles, other parts of them
  EXPECT_TRUE(ab.packets.minus.empty());

  std::vector<exact::Point3> both = p.a.vertices();
  both.insert(both.end(), p.b.vertices().begin(), p.b.vertices().end());
  const auto hull = map_of(p.scene.mesh(), exact::ConvexCell(both));
  EXPECT_EQ(hidden_area(hull, p.scene.mesh(), p.receiver, 2, false), FT(0));
}

TEST(Delta, FromACellToItselfIsNothing) {
  const SceneP p;
  const auto delta = reference::delta_of(p.scene.mesh(), p.a, p.a, {});
  for (const auto& r : delta.regions) EXPECT_TRUE(r.seen == SeenFrom::both || r.seen == SeenFrom::neither);
  EXPECT_TRUE(delta.packets.plus.empty() && delta.packets.minus.empty());
}

TEST(Delta, PacketsAreTheDifferencesOfTheLists) {
  const auto packets = reference::packets_of({1, 2, 5, 9}, {2, 3, 9, 10});
  EXPECT_EQ(packets.plus, (std::vector<std::uint32_t>{3, 10}));
  EXPECT_EQ(packets.minus, (std::vector<std::uint32_t>{1, 5}));
}

// A triangle that stands in the one cell blocks nothing there (D3) and everything for the other.
TEST(Delta, RegionsAreOnInputTrianglesThoughTheComplexesDiffer) {
  SceneBuilder scene;
  scene.box({-1.5, -0.5, -0.75}, {-0.5, 0.5, -0.25});
  const auto receiver = scene.plate(-20, -20, 20, 20, 8);
  const SceneP p;
  const auto delta = reference::delta_of(scene.mesh(), p.a, p.b, {});
  std::map<std::uint32_t, FT> sums;
  for (const auto& r : delta.regions) {
    const auto [at, fresh] = sums.try_emplace(2 * r.side.triangle + (r.side.front ? 0U : 1U), FT(0));
    at->second += r.area_fraction;
  }
  EXPECT_EQ(sums.size(), 2 * scene.mesh().triangles.size());
  for (const auto& [side, sum] : sums) EXPECT_EQ(sum, FT(1)) << side;
  for (const auto& r : delta.regions) {
    if (r.side.triangle < receiver) {
      EXPECT_TRUE(r.seen == SeenFrom::from || r.seen == SeenFrom::both);  // in A both sides are seen
    }
  }
}

}  // namespace
}  // namespace clues::test
