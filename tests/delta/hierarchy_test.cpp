// FIGS. 42, 52, 54: streams with nodes above the cells. Sound at every step, whatever level was sent; never more than
// the coarsest node adds; wrong ones are caught.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>

#include "reference/link/link_simulator.h"
#include "reference/streams/cell_tree.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/reference/support.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using reference::CellTree;
using Messages = std::vector<scene::StreamMessage>;

reference::StreamStore store_with(std::size_t levels, int horizon) {
  return {town().mesh(), town().lists(), town().neighbours(), horizon, reference::cell_tree(town().cells(), levels)};
}

void append(Messages& all, Messages more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::string lines_of(const Messages& messages) {
  std::string text;
  for (const auto& m : messages) text += scene::to_line(m);
  return text;
}

TEST(CellTree, NodesOfAGridAreBlocks) {
  const CellTree tree = reference::cell_tree(scene::parse_cells("grid:4x4x2:box:0,0,0,4,4,2"), 3);
  ASSERT_EQ(tree.node_of.size(), 4U);
  // Level 3: 2x2x2 cells; x fastest.
  const auto& node = tree.node_of[3];
  for (std::uint32_t c = 0; c < 32; ++c) {
    const std::uint32_t x = c % 4, y = c / 4 % 4;
    EXPECT_EQ(node[c] == node[0], x < 2 && y < 2) << c;
  }
}

TEST(CellTree, LevelsAreNestedAndNodesAreSmall) {
  std::mt19937_64 random(kSeed);
  std::vector<std::vector<scene::Point>> cells;
  for (int i = 0; i < 100; ++i) {
    const scene::Point p{static_cast<double>(random() % 50), static_cast<double>(random() % 50), 0};
    cells.push_back({p, {p[0] + 1, p[1] + 1, 1}});
  }
  const CellTree tree = reference::cell_tree(cells, 5);
  for (std::size_t level = 0; level < tree.node_of.size(); ++level) {
    std::map<std::uint32_t, std::size_t> sizes;
    for (const std::uint32_t node : tree.node_of[level]) ++sizes[node];
    for (const auto& [node, size] : sizes) EXPECT_LE(size, std::size_t{1} << level);
    EXPECT_EQ(sizes.rbegin()->first + 1, sizes.size());  // numbered from 0, none left out
    if (level == 0) {
      EXPECT_EQ(sizes.size(), cells.size());
      continue;
    }
    std::map<std::uint32_t, std::uint32_t> above;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto [at, fresh] = above.try_emplace(tree.node_of[level - 1][c], tree.node_of[level][c]);
      EXPECT_EQ(at->second, tree.node_of[level][c]);
    }
  }
}

// T6: what the cells of a node list together is in the list of the box around them.
TEST(CellTree, ANodeListsNoMoreThanItsBox) {
  const auto lists = reference::lists_of_nodes(std::vector<std::uint32_t>(18, 0), town().lists());
  ASSERT_EQ(lists.size(), 1U);
  const auto map = map_of(town().mesh(), box_cell(-2.5, -2.5, 0, 2.5, 2.5, 2));
  EXPECT_TRUE(std::includes(map.visible.begin(), map.visible.end(), lists[0].begin(), lists[0].end()));
  for (const auto& list : town().lists())
    EXPECT_TRUE(std::includes(lists[0].begin(), lists[0].end(), list.begin(), list.end()));
}

// After each step the client has what the cell sees, and nothing that the coarsest node does not want; so it is sound
// whatever it had before, and each step may be on any level.
TEST(StreamHierarchy, EveryTransitionIsSoundOnEveryLevel) {
  for (const int horizon : {0, 1}) {
    const auto store = store_with(3, horizon);
    for (std::uint32_t a = 0; a < town().neighbours().size(); ++a) {
      for (const std::uint32_t b : town().neighbours()[a]) {
        for (const std::size_t before : {0U, 3U}) {
          for (std::size_t level = 0; level <= store.coarsest(); ++level) {
            reference::StreamServer server(store);
            Messages all = server.enter(a, before);
            append(all, server.enter(b, level));
            for (const auto& f : town().judge(all).findings)
              ADD_FAILURE() << a << " to " << b << ", level " << level << ": " << f.what;
            const auto held = server.mirror().triangles();
            for (const auto& [small, large] : {std::pair(store.seen_from(b), held),
                                               {store.wanted_in(b, level), held},
                                               {held, store.wanted_in(b, store.coarsest())}})
              EXPECT_TRUE(std::includes(large.begin(), large.end(), small.begin(), small.end()));
          }
        }
      }
    }
  }
}

TEST(StreamHierarchy, WithoutNodesItIsTheFlatStream) {
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  for (const int horizon : {0, 1}) {
    const auto store = store_with(0, horizon);
    reference::StreamServer server(store);
    Messages all;
    for (const std::uint32_t cell : route) append(all, server.enter(cell));
    EXPECT_EQ(lines_of(all), lines_of(town().stream(route, horizon)));
  }
}

TEST(StreamHierarchy, WithinANodeNothingIsSent) {
  const auto store = store_with(3, 0);
  const auto tree = reference::cell_tree(town().cells(), 3);
  std::uint64_t within = 0;
  for (std::uint32_t a = 0; a < town().neighbours().size(); ++a) {
    for (const std::uint32_t b : town().neighbours()[a]) {
      if (tree.node_of[3][a] != tree.node_of[3][b]) continue;
      reference::StreamServer server(store);
      server.enter(a);
      const auto step = server.enter(b);
      ASSERT_EQ(step.size(), 1U);
      EXPECT_EQ(step[0].kind, scene::StreamMessage::Kind::cell);
      ++within;
    }
  }
  EXPECT_GT(within, 10U);
}

TEST(StreamHierarchy, RandomLevelsOnRandomRoutesAreSoundAndTakenUpAnywhere) {
  const auto store = store_with(3, 1);
  std::mt19937_64 random(kSeed);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto route = scene::random_route(town().neighbours(), 20, kSeed + seed);
    std::vector<std::size_t> levels;
    reference::StreamServer server(store);
    validate::StreamClient client(town().mesh());
    Messages all;
    for (const std::uint32_t cell : route) {
      levels.push_back(random() % 4);
      for (auto& message : server.enter(cell, levels.back())) {
        EXPECT_TRUE(client.apply(message).empty());
        all.push_back(std::move(message));
      }
      ASSERT_EQ(server.mirror().bytes(), client.bytes());
    }
    EXPECT_TRUE(town().judge(all).findings.empty());
    for (std::size_t have = 0; have <= all.size(); have += 3) {
      reference::StreamServer other(store);
      EXPECT_EQ(lines_of(other.resume(route, have, levels)),
                lines_of({all.begin() + static_cast<std::ptrdiff_t>(have), all.end()}));
    }
  }
}

TEST(StreamHierarchy, TheDigestSaysWhichNodes) {
  EXPECT_EQ(store_with(0, 0).digest(), town().store(0).digest());
  EXPECT_NE(store_with(2, 0).digest(), store_with(3, 0).digest());
}

// A viewer who is in another cell each second.
reference::LinkReport over_link(const reference::StreamStore& store, const std::vector<std::uint32_t>& route,
                                const reference::Link& link, std::uint64_t ahead_us, reference::NodeChoice choice) {
  std::vector<reference::TimedStep> steps;
  for (const std::uint32_t cell : route) steps.push_back({1000000 * (1 + steps.size()), cell, 1000000});
  return reference::walk_over(store, steps, link, ahead_us, choice);
}

TEST(HierarchyOverALink, TheNodeThatComesInTimeIsTaken) {
  const auto route = scene::random_route(town().neighbours(), 40, kSeed);
  const auto store = store_with(3, 1);
  reference::Link link;
  link.latency_us = 20000;
  for (const std::uint64_t rate : {200U, 1000U, 5000U, 1000000U}) {
    link.bytes_per_second = rate;
    const auto chosen = over_link(store, route, link, 100000, reference::NodeChoice::in_time);
    EXPECT_TRUE(town().judge(chosen.messages).findings.empty());
    const auto all = over_link(store, route, link, 100000, reference::NodeChoice::coarsest);
    EXPECT_TRUE(town().judge(all.messages).findings.empty());
    EXPECT_LE(chosen.stalled_us, all.stalled_us) << rate;
    EXPECT_LE(chosen.held, all.held);
    EXPECT_EQ(all.steps_on_level.back(), route.size());
    if (rate == 1000000U) {
      EXPECT_EQ(lines_of(chosen.messages), lines_of(all.messages));
    } else if (rate == 200U) {
      EXPECT_GT(chosen.steps_on_level[0], 0U);
    }
  }
}

// FIG. 48B. One step is late: of half a second that he asks ahead he has to make as much as it takes.
TEST(LinkSimulator, SaysHowSlowHeWouldHaveToGo) {
  const auto route = scene::random_route(town().neighbours(), 1, kSeed);
  reference::Link link;
  link.latency_us = 400000;
  link.bytes_per_second = 1000000000;
  const auto report = over_link(town().store(1), route, link, 500000, reference::NodeChoice::coarsest);
  ASSERT_EQ(report.stalls, 2U);
  // 0.5 s of way in the 0.8 s of both latencies and what the bytes take, in 1024ths rounded down.
  EXPECT_LE(report.slowest, exact::FT(640) / 1024);
  EXPECT_GE(report.slowest, exact::FT(639) / 1024);
  const auto on_the_face = over_link(town().store(1), route, link, 0, reference::NodeChoice::coarsest);
  EXPECT_EQ(on_the_face.slowest, exact::FT(0));
  link.latency_us = 0;
  EXPECT_EQ(over_link(town().store(1), route, link, 500000, reference::NodeChoice::coarsest).slowest, exact::FT(1));
}

TEST(HierarchyOverALink, LossesLeaveNoHole) {
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  const auto store = store_with(3, 1);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const reference::Link link{2000, 50000, 300000, 700000, seed};
    const auto report = over_link(store, route, link, 0, reference::NodeChoice::in_time);
    EXPECT_GT(report.losses, 0U);
    EXPECT_TRUE(town().judge(report.messages).findings.empty());
    EXPECT_EQ(over_link(store, route, link, 0, reference::NodeChoice::in_time).stalled_us, report.stalled_us);
  }
}

// A server that trusts its nodes: the node's list when the viewer comes into the node, and nothing within it.
class PlantedHierarchy : public ::testing::Test {
 protected:
  PlantedHierarchy()
      : tree_(reference::cell_tree(town().cells(), 3)),
        lists_(reference::lists_of_nodes(tree_.node_of[3], town().lists())) {}

  std::uint32_t node(std::uint32_t cell) const { return tree_.node_of[3][cell]; }

  // `gone`: what is taken away after a step from the first cell into the second, whose nodes are others.
  template <class Gone>
  Messages step(std::uint32_t a, std::uint32_t b, const Gone& gone) const {
    reference::DisplayList client(town().mesh());
    Messages all{client.plus(lists_[node(a)])};
    scene::StreamMessage entered;
    entered.cell = a;
    all.push_back(entered);
    entered.cell = b;
    if (node(a) == node(b)) {
      all.push_back(entered);
      return all;
    }
    const auto packets = reference::packets_of(client.triangles(), lists_[node(b)]);
    if (!packets.plus.empty()) all.push_back(client.plus(packets.plus));
    all.push_back(entered);
    const auto minus = gone(packets, client.triangles());
    if (!minus.empty()) all.push_back(client.minus(minus));
    return all;
  }
  static std::vector<std::uint32_t> right(const reference::DeltaPackets& packets, const std::vector<std::uint32_t>&) {
    return packets.minus;
  }
  template <class Gone>
  std::uint64_t caught_by_a_sight_line(const Gone& gone) const {
    std::uint64_t caught = 0;
    for (std::uint32_t a = 0; a < town().lists().size(); ++a) {
      for (const std::uint32_t b : town().neighbours()[a]) {
        const auto verdict = town().judge(step(a, b, gone));
        caught += std::any_of(verdict.findings.begin(), verdict.findings.end(),
                              [](const auto& f) { return f.witness.has_value(); })
                      ? 1U
                      : 0U;
      }
    }
    return caught;
  }

  CellTree tree_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

TEST_F(PlantedHierarchy, TheRightOneIsSound) { EXPECT_EQ(caught_by_a_sight_line(right), 0U); }

TEST_F(PlantedHierarchy, ANodeThatIsDroppedWhileACellNeedsIt) {
  EXPECT_GT(caught_by_a_sight_line([&](const auto&, const std::vector<std::uint32_t>& held) {
              std::vector<std::uint32_t> all_of_it;
              std::set_intersection(held.begin(), held.end(), lists_[0].begin(), lists_[0].end(),
                                    std::back_inserter(all_of_it));
              return all_of_it;
            }),
            0U);
}

TEST_F(PlantedHierarchy, ANodeThatLacksATriangleOfACell) {
  std::uint64_t caught = 0;
  for (std::uint32_t n = 0; n < lists_.size(); ++n) {
    const auto whole = lists_[n];
    for (const std::uint32_t t : whole) {
      std::erase(lists_[n], t);
      EXPECT_GT(caught_by_a_sight_line(right), 0U) << "node " << n << ", triangle " << t;
      ++caught;
      lists_[n] = whole;
      if (caught % 5 == 0) break;  // a few of each node: all of them take their time
    }
  }
  EXPECT_GE(caught, lists_.size());
}

TEST(HierarchyCommands, WalkAndServeHaveIt) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string cells = "grid:4x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0";
  const std::vector<std::string> walk{"walk", "screen.off", "--cells", cells, "--steps", "10"};
  ASSERT_EQ(tests::run_clues(walk, {"--hierarchy", "2", "-o", "walk"}, folder.path()).exit_code, 0);
  const auto judged =
      tests::run_clues({"conform", "--stream", "walk", "--scene", "screen.off", "--cells", cells}, folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  const auto served = tests::run_clues(
      {"conform", "--stream-server", std::string(CLUES_PROGRAM) + " serve screen.off --hierarchy 2 --cells " + cells,
       "--scene", "screen.off", "--cells", cells, "--steps", "6"},
      folder.path());
  EXPECT_EQ(served.exit_code, 0) << served.out << served.err;
  const auto linked = tests::run_clues(walk, {"--hierarchy", "2", "--link", "1000:10", "--in-time"}, folder.path());
  EXPECT_EQ(linked.exit_code, 0) << linked.err;
  EXPECT_NE(linked.out.find("steps by level of the hierarchy: "), std::string::npos) << linked.out;
  EXPECT_EQ(tests::run_clues(walk, {"--link", "1000:10", "--in-time"}, folder.path()).exit_code, 2);
  EXPECT_EQ(tests::run_clues(walk, {"--hierarchy", "17"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace clues::test
