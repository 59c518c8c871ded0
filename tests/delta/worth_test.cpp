// ESO, EDO, EDV as area for each byte (area_worth.h), and packets that are dropped by it: a fixpoint, sound on every
// route.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>

#include "reference/streams/area_worth.h"
#include "reference/streams/worth.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using exact::FT;
using reference::AreaWorth;
using ListsOfCells = std::vector<std::vector<std::uint32_t>>;

TEST(RootAbove, IsTheLeastDouble) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(kSeed);
  std::vector<FT> squares{FT(2), FT(1e300) * FT(1e300), FT(1e-300) * FT(1e-300), FT(5e-324), FT(1) / 3, FT(0.49)};
  for (int i = 0; i < 50; ++i) squares.push_back(FT(static_cast<double>(random() % 1000000)) / 7);
  for (const FT& square : squares) {
    const auto root = reference::root_above(square);
    ASSERT_TRUE(root);
    EXPECT_GE(FT(*root) * FT(*root), square);
    const double less = std::nextafter(*root, -infinity);
    EXPECT_TRUE(*root == 0 || FT(less) * FT(less) < square);
  }
  EXPECT_EQ(reference::root_above(FT(0)), 0.0);
  EXPECT_EQ(reference::root_above(FT(49)), 7.0);
  EXPECT_FALSE(reference::root_above(FT(1e308) * FT(1e308) * 16));
}

TEST(AreaWorth, OfScenePIsExact) {
  SceneBuilder scene;
  scene.plate(-1, -1, 1, 1, 4);
  scene.plate(-20, -20, 20, 20, 8);
  const auto delta = reference::delta_of(scene.mesh(), box_cell(-2, -1, -1, 0, 1, 0), box_cell(0, -1, -1, 2, 1, 0), {});
  const AreaWorth worth(scene.mesh());
  EXPECT_EQ(worth.area_of({0, 1}), FT(4));
  EXPECT_EQ(worth.area_of({2, 3}), FT(1600));
  EXPECT_EQ(worth.area_of(delta, reference::SeenFrom::to), FT(18) / 5);    // DR_E
  EXPECT_EQ(worth.area_of(delta, reference::SeenFrom::from), FT(18) / 5);  // DR_O
  // Kind and length, then 6 vertices, since nothing is shared, and 2 triangles.
  EXPECT_EQ(worth.bytes_of_plus({0, 1}), 5U + 4U + 6U * 28U + 4U + 2U * 20U);
  EXPECT_EQ(worth.bytes_of_minus({0, 1}), 5U + 4U + 2U * 4U + 4U + 6U * 4U);
}

TEST(AreaWorth, WhatNoDoubleHoldsIsNeverPoor) {
  scene::TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const AreaWorth worth(mesh);
  EXPECT_FALSE(worth.area_of({0, 1}));
  EXPECT_EQ(worth.area_of({1}), FT(1) / 2);
  EXPECT_FALSE(worth.is_poor({0, 1}, FT(1e300)));
  EXPECT_TRUE(worth.is_poor({1}, FT(1)));
}

reference::Dropping dropped_by_area(const ListsOfCells& lists, const ListsOfCells& neighbours, double area_of_a_byte) {
  const AreaWorth worth(town().mesh());
  return reference::without_poor_packets(lists, neighbours,
                                         [&](const auto& plus) { return worth.is_poor(plus, FT(area_of_a_byte)); });
}

// Something is dropped at the smaller of these, and not all of it.
constexpr double some_area = 0.005, much_area = 1000;

TEST(AreaWorth, DroppingIsAFixpointAndSoundOnEveryRoute) {
  const AreaWorth worth(town().mesh());
  for (const double area : {0.0, some_area, much_area}) {
    const auto dropped = dropped_by_area(town().lists(), town().neighbours(), area);
    const reference::StreamStore store(town().mesh(), dropped.lists, town().neighbours(), 0);
    for (std::uint32_t a = 0; a < dropped.lists.size(); ++a) {
      EXPECT_TRUE(std::includes(dropped.lists[a].begin(), dropped.lists[a].end(), town().lists()[a].begin(),
                                town().lists()[a].end()));
      for (const std::uint32_t b : town().neighbours()[a]) {
        const auto plus = reference::packets_of(dropped.lists[a], dropped.lists[b]).plus;
        EXPECT_TRUE(plus.empty() || !worth.is_poor(plus, FT(area)));
        reference::StreamServer server(store);
        std::vector<scene::StreamMessage> all;
        for (const std::uint32_t cell : {a, b}) {
          for (auto& m : server.enter(cell)) all.push_back(std::move(m));
        }
        EXPECT_TRUE(town().judge(all).findings.empty());
      }
    }
    EXPECT_EQ(dropped.given_up == 0, area == 0.0);
    EXPECT_EQ(dropped.packets_after == 0, area == much_area);
    const auto left = reference::plus_totals(worth, dropped.lists, town().neighbours());
    EXPECT_EQ(left.packets, dropped.packets_after);
  }
}

TEST(AreaWorth, HowCellsAreNumberedDoesNotMatter) {
  const auto cells = static_cast<std::uint32_t>(town().lists().size());
  std::vector<std::uint32_t> number(cells);
  std::iota(number.begin(), number.end(), 0U);
  std::mt19937_64 random(kSeed);
  std::shuffle(number.begin(), number.end(), random);
  ListsOfCells lists(cells), neighbours(cells);
  for (std::uint32_t c = 0; c < cells; ++c) {
    lists[number[c]] = town().lists()[c];
    for (const std::uint32_t n : town().neighbours()[c]) neighbours[number[c]].push_back(number[n]);
    std::sort(neighbours[number[c]].begin(), neighbours[number[c]].end());
  }
  const auto one = dropped_by_area(town().lists(), town().neighbours(), some_area),
             other = dropped_by_area(lists, neighbours, some_area);
  for (std::uint32_t c = 0; c < cells; ++c) EXPECT_EQ(one.lists[c], other.lists[number[c]]);
  EXPECT_EQ(one.given_up, other.given_up);
  EXPECT_EQ(one.rounds, other.rounds);
}

// A server that drops what is poor, and gives it to the cell before on one way only: to who begins there. Who comes
// from elsewhere has the list as it was.
std::vector<scene::StreamMessage> dropped_for_one_way(std::uint32_t c, std::uint32_t a, std::uint32_t b,
                                                      const AreaWorth& worth, double area) {
  const auto& lists = town().lists();
  reference::DisplayList client(town().mesh());
  std::vector<scene::StreamMessage> all{client.plus(lists[c])};
  const auto step = [&](std::uint32_t cell, const std::vector<std::uint32_t>& plus) {
    if (!plus.empty()) all.push_back(client.plus(plus));
    all.emplace_back();
    all.back().cell = cell;
    const auto minus = reference::packets_of(client.triangles(), lists[cell]).minus;
    if (!minus.empty()) all.push_back(client.minus(minus));
  };
  step(c, {});
  step(a, reference::packets_of(client.triangles(), lists[a]).plus);
  const auto plus = reference::packets_of(client.triangles(), lists[b]).plus;
  step(b, worth.is_poor(plus, FT(area)) ? std::vector<std::uint32_t>{} : plus);
  return all;
}

TEST(PlantedWorth, HazardA24APoorPacketThatIsDroppedForOneWayOnly) {
  const AreaWorth worth(town().mesh());
  std::uint64_t caught = 0;
  for (std::uint32_t a = 0; a < town().lists().size(); ++a) {
    for (const std::uint32_t c : town().neighbours()[a]) {
      for (const std::uint32_t b : town().neighbours()[a]) {
        EXPECT_TRUE(town().judge(dropped_for_one_way(c, a, b, worth, 0)).findings.empty());
        const auto plus = reference::packets_of(town().lists()[a], town().lists()[b]).plus;
        if (plus.empty() || !worth.is_poor(plus, FT(some_area))) continue;
        const auto verdict = town().judge(dropped_for_one_way(c, a, b, worth, some_area));
        EXPECT_TRUE(std::any_of(verdict.findings.begin(), verdict.findings.end(),
                                [](const auto& f) { return f.witness.has_value(); }));
        ++caught;
      }
    }
  }
  EXPECT_GT(caught, 0U);
}

TEST(WorthCommands, DropByAreaAndSayWhatItCosts) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string cells = "grid:2x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0";
  const std::vector<std::string> walk{"walk", "screen.off", "--cells", cells, "--steps", "10", "-o", "walk"};
  const auto ran = tests::run_clues(walk, {"--drop-area", "1000"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("dropped: over all transitions 0 packets + of "), std::string::npos) << ran.out;
  const auto judged =
      tests::run_clues({"conform", "--stream", "walk", "--scene", "screen.off", "--cells", cells}, folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  for (const char* bad : {"-1", "nan", "inf", "x"})
    EXPECT_EQ(tests::run_clues(walk, {"--drop-area", bad}, folder.path()).exit_code, 2) << bad;
  const auto delta = tests::run_clues(
      {"delta", "screen.off", "--from", "box:-0.25,-0.25,-0.25,0,0.25,0", "--to", "box:0,-0.25,-0.25,0.25,0.25,0"},
      folder.path());
  EXPECT_EQ(delta.exit_code, 0) << delta.err;
  EXPECT_NE(delta.out.find("area of regions"), std::string::npos) << delta.out;
}

}  // namespace
}  // namespace clues::test
