// FIG. 52: files of lists (list_store.h). Each record decodes to what it was made of, lists only grow where area is given
// up, a stream from the file is that from the bake, and a contour that is shared wrongly is caught by a sight line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "reference/streams/list_store.h"
#include "scene/messages/error.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/floor_lists.h"
#include "tests/delta/town.h"
#include "tests/read_all.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

std::set<RecordKind> kinds_in(const ListLevels& levels) {
  std::set<RecordKind> kinds;
  for (const auto& level : levels) {
    for (const auto& place : level) kinds.insert(place.record.kind);
  }
  return kinds;
}

TEST(ListStore, DecodesToWhatItWasMadeOf) {
  std::set<RecordKind> met;
  for (const double step : {0.0, 0.25, 1.0}) {
    for (const double r : {2.0, 5.0, 9.0}) {
      const Row row = row_of_discs(step, r);
      for (const auto& levels : {std::vector<std::size_t>{}, {1}, {2}, {3, 2}, {4, 3, 2, 1}}) {
        const auto stored = made(row, levels);
        ASSERT_EQ(stored.size(), levels.size() + 1);
        const auto decoded = reference::decoded_levels(floor_scene().edges, stored);
        EXPECT_EQ(decoded.back(), row.lists);
        for (std::size_t i = 0; i < levels.size(); ++i)
          EXPECT_EQ(decoded[i], reference::lists_of_nodes(row.tree.node_of[levels[i]], row.lists));
        met.merge(kinds_in(stored));
        const auto file = file_with(stored, floor_scene().mesh.triangles.size());
        EXPECT_EQ(scene::parse_lists(scene::to_bytes(file), "x"), file);
      }
    }
  }
  // Each way is the cheapest somewhere, but for `goes`, where edges are shared.
  for (const auto kind : {RecordKind::list, RecordKind::all, RecordKind::contour, RecordKind::same, RecordKind::delta})
    EXPECT_TRUE(met.contains(kind)) << static_cast<int>(kind);
}

TEST(ListStore, RandomListsOfRandomTreesComeBack) {
  std::mt19937_64 random(kSeed);
  std::set<RecordKind> met;
  for (int i = 0; i < 60; ++i) {
    Row row = row_of_discs(0.5, 4);
    ManyLists shapes;
    for (int k = 0; k < 6; ++k) {
      const auto at = [&random] { return static_cast<double>(random() % floor_size); };
      const double x = at(), y = at();
      shapes.push_back(disc(floor_size, x, y, 4));
    }
    for (auto& list : row.lists) {
      if (i % 2 == 0) {  // each has some of the same shapes
        std::set<std::uint32_t> all;
        for (const auto& shape : shapes) {
          if (random() % 2 == 0) all.insert(shape.begin(), shape.end());
        }
        list.assign(all.begin(), all.end());
      } else {  // or lacks a few triangles here and there
        const std::uint64_t share = 1 + random() % 20;
        std::erase_if(list, [&](std::uint32_t) { return random() % share == 0; });
      }
    }
    const std::vector<std::size_t> levels = i % 3 == 0 ? std::vector<std::size_t>{4, 2} : std::vector<std::size_t>{4};
    const auto stored = made(row, levels);
    met.merge(kinds_in(stored));
    EXPECT_EQ(reference::decoded_levels(floor_scene().edges, stored).back(), row.lists);
  }
  EXPECT_TRUE(met.contains(RecordKind::goes));
  EXPECT_TRUE(met.contains(RecordKind::changed));
}

// FIGS. 33 C, D: more is listed, never less, and no more than the bytes are worth.
TEST(ListStore, MoreIsGivenUpForMoreArea) {
  const Row row = row_of_discs(0.25, 5);
  std::size_t before = scene::to_bytes(file_with(made(row, {3}), 0)).size();
  for (const double give_up : {0.1, 1.0, 10.0, 1e6}) {
    const auto stored = made(row, {3}, give_up);
    const auto decoded = reference::decoded_levels(floor_scene().edges, stored);
    exact::FT area = 0;
    for (std::size_t c = 0; c < row.lists.size(); ++c) {
      const auto &more = decoded.back()[c], &less = row.lists[c];
      EXPECT_TRUE(std::includes(more.begin(), more.end(), less.begin(), less.end())) << c;
      area += *floor_scene().worth.area_of(reference::packets_of(less, more).plus);
    }
    const std::size_t bytes = scene::to_bytes(file_with(stored, 0)).size();
    EXPECT_LE(bytes, before);
    before = bytes;
    if (give_up == 1e6) {
      EXPECT_GT(area, exact::FT(0));
    }
  }
}

// The second cell sees one of two triangles, of an area of 1/2 each: three bytes say so, and one that it sees both. So
// two bytes are saved by an area of 1/2, which is worth it from 1/4 for each byte on, and not from a unit in the last place
// below. Lists of nodes are not given up: those of two cells are one of both.
TEST(ListStore, WhatIsGivenUpIsWorthIt) {
  Row row;
  row.lists = {{0, 1}, {0}};
  row.tree = reference::cell_tree({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, 1);
  const auto records = [&](double give_up) {
    const auto stored = made(row, {1}, give_up);
    EXPECT_EQ(stored[0].size(), 1U);
    EXPECT_EQ(stored[1][0].record.kind, RecordKind::all);
    return std::pair(stored[1][1].record, reference::decoded_levels(floor_scene().edges, stored).back()[1]);
  };
  for (const double give_up : {0.0, 0.1, std::nextafter(0.25, 0)}) {
    EXPECT_EQ(records(give_up).second, row.lists[1]) << give_up;
    EXPECT_EQ(scene::record_bytes(records(give_up).first, 1).size(), 3U) << give_up;
  }
  for (const double give_up : {0.25, 1.0}) {
    EXPECT_EQ(records(give_up).second, row.lists[0]) << give_up;
    EXPECT_EQ(records(give_up).first.kind, RecordKind::all);
  }
}

// Whatever is given up on whichever levels: sound from each cell to each of its neighbours, as the lists of all levels hold
// what their cells see.
TEST(ListStore, EveryTransitionIsSoundWhateverIsGivenUp) {
  StoreScene s(town().mesh());
  std::vector<std::vector<scene::Point>> corners;
  for (const auto& cell : scene::parse_cells("grid:3x3x2:box:-2.5,-2.5,0,2.5,2.5,2")) corners.push_back(cell.points);
  const auto tree = reference::cell_tree(corners, 4);
  const auto& lists = town().lists();
  std::set<std::size_t> listed;
  for (const double give_up : {0.0, 0.1, 1.0, 1e9}) {
    for (const auto& levels : {std::vector<std::size_t>{}, {2}, {4, 2}}) {
      const auto decoded = reference::decoded_levels(
          s.edges, reference::made_levels(s.edges, s.worth, lists, tree, {levels, exact::FT(give_up)}));
      for (std::size_t i = 0; i < decoded.size(); ++i) {
        const auto least = i < levels.size() ? reference::lists_of_nodes(tree.node_of[levels[i]], lists) : lists;
        ASSERT_EQ(decoded[i].size(), least.size());
        for (std::size_t n = 0; n < least.size(); ++n)
          EXPECT_TRUE(std::includes(decoded[i][n].begin(), decoded[i][n].end(), least[n].begin(), least[n].end()));
      }
      std::size_t sum = 0;
      for (const auto& list : decoded.back()) sum += list.size();
      listed.insert(sum);
      const reference::StreamStore store(town().mesh(), decoded.back(), town().neighbours(), 0);
      for (std::uint32_t a = 0; a < lists.size(); ++a) {
        for (const std::uint32_t b : town().neighbours()[a]) {
          reference::StreamServer server(store);
          std::vector<scene::StreamMessage> all;
          for (const std::uint32_t cell : {a, b}) {
            for (auto& m : server.enter(cell)) all.push_back(std::move(m));
          }
          EXPECT_TRUE(town().judge(all).findings.empty()) << a << " to " << b;
        }
      }
    }
  }
  EXPECT_GT(listed.size(), 2U);  // something was given up, and not always the same
}

// The file is a bake as far as streams go.
TEST(ListStore, AStreamFromTheFileIsThatFromTheBake) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const auto run = [&](std::vector<std::string> args) {
    const auto ran = tests::run_clues(args, folder.path());
    EXPECT_EQ(ran.exit_code, 0) << args[0] << ran.out << ran.err;
    return ran.out;
  };
  run({"bake", "screen.off", "--cells", "grid:4x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0", "-o", "s.bake"});
  using Words = std::vector<std::string>;
  for (const Words& levels : {Words{}, Words{"1"}, Words{"2"}, Words{"3"}, Words{"1", "3"}}) {
    Words args{"delta", "lists", "screen.off", "--bake", "s.bake", "-o", "s.lists"};
    if (!levels.empty()) args.emplace_back("--hierarchy");
    args.insert(args.end(), levels.begin(), levels.end());
    const auto said = run(args);
    EXPECT_NE(said.find("s.lists: 8 cells in "), std::string::npos) << said;
    for (const char* from : {"--bake", "--lists"})
      run({"walk", "screen.off", from, from == std::string("--bake") ? "s.bake" : "s.lists", "--steps", "20",
           "--hierarchy", "1", "--contours", "-o", std::string("walk") + from});
    EXPECT_EQ(tests::read_all(folder.path() / "walk--bake"), tests::read_all(folder.path() / "walk--lists"));
  }
  run({"conform", "--stream", "walk--lists", "--scene", "screen.off", "--lists", "s.lists"});
  run({"conform", "--stream-server", std::string(CLUES_PROGRAM) + " serve screen.off --lists s.lists", "--scene",
       "screen.off", "--bake", "s.bake", "--steps", "6"});
  // Where all is given up each cell lists what its node does, and the stream is sound by the bake.
  run({"delta", "lists", "screen.off", "--bake", "s.bake", "-o", "all.lists", "--hierarchy", "2", "--give-up", "1e9"});
  run({"walk", "screen.off", "--lists", "all.lists", "--steps", "20", "-o", "walk"});
  run({"conform", "--stream", "walk", "--scene", "screen.off", "--bake", "s.bake"});

  folder.write("other.off", tests::read_all(folder.path() / "screen.off") + "# other\n");
  for (const auto& [args, why] :
       {std::pair(std::vector<std::string>{"walk", "other.off", "--lists", "s.lists", "--steps", "2"},
                  "is of another scene"),
        {{"walk", "screen.off", "--lists", "s.bake", "--steps", "2"}, "is no file of lists"},
        {{"walk", "screen.off", "--lists", "s.lists", "--bake", "s.bake", "--steps", "2"}, "excludes"},
        {{"delta", "lists", "screen.off", "--bake", "s.bake"}, "--out"},
        {{"delta", "lists", "screen.off", "--bake", "s.bake", "-o", "x", "--hierarchy", "17"}, "17"},
        {{"delta", "lists", "screen.off", "--bake", "s.bake", "-o", "x", "--give-up", "-1"}, "-1"}}) {
    const auto ran = tests::run_clues(args, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << ran.out << ran.err;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
  }
}

// Contours that are shared though the first is not the more conservative: what is missing then is seen.
TEST(PlantedListStore, AContourThatIsSharedWithOneThatSeesMore) {
  StoreScene s(town().mesh());
  const auto& lists = town().lists();
  const auto whole = reference::lists_of_nodes(std::vector<std::uint32_t>(lists.size(), 0), lists)[0];
  std::uint64_t planted = 0, caught = 0;
  for (std::uint32_t a = 0; a < lists.size(); ++a) {
    for (std::uint32_t b = a + 1; b < lists.size(); ++b) {
      if (std::includes(lists[a].begin(), lists[a].end(), lists[b].begin(), lists[b].end())) continue;
      ListLevels levels(2);
      levels[0].push_back({0, {RecordKind::list, 0, whole, {}}});
      for (std::uint32_t c = 0; c < lists.size(); ++c) {
        const auto contour = reference::list_contour(s.edges, whole, lists[c]);
        levels[1].push_back({0, {RecordKind::contour, 0, contour.seeds, contour.boundary}});
      }
      levels[1][b].record = {RecordKind::same, a, {}, {}};
      const reference::StreamStore store(town().mesh(), reference::decoded_levels(s.edges, levels).back(),
                                         town().neighbours(), 0);
      reference::StreamServer server(store);
      const auto verdict = town().judge(server.enter(b));
      ++planted;
      caught += std::any_of(verdict.findings.begin(), verdict.findings.end(),
                            [](const auto& f) { return f.witness.has_value(); })
                    ? 1U
                    : 0U;
    }
  }
  EXPECT_GT(planted, 20U);
  EXPECT_EQ(caught, planted);
}

}  // namespace
}  // namespace clues::test
