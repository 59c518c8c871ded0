// FIG. 52: files of lists (list_store.h). Each record decodes to what it was made of, lists only grow where area is given
// up, a stream from the file is that from the bake, and what is wrong in a file is refused or caught by a sight line.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <random>
#include <set>

#include "reference/streams/list_store.h"
#include "scene/messages/error.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/read_all.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using scene::ListRecord;
using RecordKind = ListRecord::Kind;
using ManyLists = std::vector<std::vector<std::uint32_t>>;
using ListLevels = std::vector<std::vector<scene::ListPlace>>;

struct StoreScene {
  scene::TriangleMesh mesh;
  reference::EdgeUsers edges;
  reference::AreaWorth worth;

  explicit StoreScene(scene::TriangleMesh given) : mesh(std::move(given)), edges(mesh), worth(mesh) {}
};

// A square of 2 n^2 triangles, so that lists of them have contours.
scene::TriangleMesh floor_of(std::uint32_t n) {
  scene::TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) mesh.points.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      for (const auto& t : {scene::Triangle{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}}) {
        mesh.face_of.push_back(mesh.triangles.size());
        mesh.triangles.push_back(t);
      }
    }
  }
  return mesh;
}

// All triangles of the floor whose square is within r of (x, y).
std::vector<std::uint32_t> disc(std::uint32_t n, double x, double y, double r) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const double dx = static_cast<double>(i % n) - x, dy = static_cast<double>(i / n) - y;
    if (dx * dx + dy * dy > r * r) continue;
    out.push_back(2 * i);
    out.push_back(2 * i + 1);
  }
  return out;
}

constexpr std::uint32_t floor_size = 24;

StoreScene& floor_scene() {
  static StoreScene scene(floor_of(floor_size));
  return scene;
}

// 16 cells in a row, in nodes of 4 and of 8, with discs that move on.
struct Row {
  ManyLists lists;
  reference::CellTree tree;
};
Row row_of_discs(double step, double r) {
  Row row;
  std::vector<std::vector<scene::Point>> corners;
  for (int c = 0; c < 16; ++c) {
    row.lists.push_back(disc(floor_size, 4 + step * c, 12, r));
    corners.push_back({{1.0 * c, 0, 0}, {1.0 * c + 1, 1, 1}});
  }
  row.tree = reference::cell_tree(corners, 4);
  return row;
}

ListLevels made(const Row& row, std::vector<std::size_t> levels, double give_up = 0) {
  StoreScene& s = floor_scene();
  return reference::made_levels(s.edges, s.worth, row.lists, row.tree, {std::move(levels), exact::FT(give_up)});
}

std::set<RecordKind> kinds_in(const ListLevels& levels) {
  std::set<RecordKind> kinds;
  for (const auto& level : levels) {
    for (const auto& place : level) kinds.insert(place.record.kind);
  }
  return kinds;
}

scene::ListFile file_with(ListLevels levels, std::uint64_t triangles) {
  scene::ListFile file;
  file.scene_sha256 = std::string(64, 'a');
  file.scene_triangles = triangles;
  file.question = "a row";
  for (std::size_t c = 0; c < levels.back().size(); ++c)
    file.cells.push_back({std::to_string(c), {{0.5 * static_cast<double>(c), -0.0, 0}, {1, 1, 1}}, {}});
  file.levels = std::move(levels);
  return file;
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
TEST(ListStore, WhatIsGivenUpIsWorthIt) {
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
  for (const std::string levels : {"1", "2", "3"}) {
    const auto said = run({"delta", "lists", "screen.off", "--bake", "s.bake", "-o", "s.lists", "--hierarchy", levels});
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

TEST(ListStore, FilesThatAreCutOrChangedAreRefused) {
  const auto bytes = scene::to_bytes(file_with(made(row_of_discs(1, 3), {2}), floor_scene().mesh.triangles.size()));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(scene::parse_lists(bytes.substr(0, size), "x"), scene::Error);
  std::mt19937_64 random(kSeed);
  std::uint64_t read = 0, decoded = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (random() % 8)));
    EXPECT_THROW(scene::parse_lists(changed, "x"), scene::Error);
    if (at >= bytes.size() - 32) continue;
    // Without the hash: another file, or none; what a record does not fit is refused.
    try {
      const auto file = scene::parse_unsealed_lists(changed.substr(0, bytes.size() - 32), "x");
      ++read;
      reference::decoded_levels(floor_scene().edges, file.levels);
      ++decoded;
    } catch (const scene::Error& e) {
      EXPECT_NE(e.code(), scene::ErrorCode::internal) << e.what();
    }
  }
  EXPECT_GT(read, 100U);
  EXPECT_GT(decoded, 50U);
  EXPECT_LT(decoded, read);
}

TEST(ListStore, RecordsThatDoNotFitAreRefused) {
  const auto triangles = static_cast<std::uint32_t>(floor_scene().mesh.triangles.size());
  const auto refused = [](const ListLevels& levels) {
    try {
      reference::decoded_levels(floor_scene().edges, levels);
      return std::string();
    } catch (const scene::Error& e) {
      EXPECT_EQ(e.code(), scene::ErrorCode::malformed);
      return std::string(e.what());
    }
  };
  const std::vector<scene::ListPlace> node{{0, {RecordKind::list, 0, {1, 2, 3}, {}}}};
  EXPECT_EQ(refused({node}), "");
  for (const auto& [levels, why] :
       {std::pair<ListLevels, const char*>({{{0, {RecordKind::list, 0, {triangles}, {}}}}}, "does not have"),
        {{{{0, {RecordKind::all, 0, {}, {}}}}}, "a list that there is not"},
        {{{{0, {RecordKind::goes, 0, {1}, {}}}}}, "a list that there is not"},
        {{{{0, {RecordKind::contour, 0, {1}, {}}}}}, "a list that there is not"},
        {{node, {{0, {RecordKind::list, 0, {4}, {}}}}}, "has more than"},
        {{node, {{0, {RecordKind::goes, 0, {4}, {}}}}}, "what is not there"},
        {{node, {{0, {RecordKind::contour, 0, {4}, {}}}}}, "begins outside"},
        {{node, {{0, {RecordKind::contour, 0, {1}, {3 * triangles}}}}}, "an edge"},
        {{{node[0], {0, {RecordKind::delta, 0, {}, {7}}}}}, "what is not there"},
        {{{node[0], {0, {RecordKind::delta, 0, {1}, {}}}}}, "brings what is there"}})
    EXPECT_NE(refused(levels).find(why), std::string::npos) << why << ": " << refused(levels);
}

// A small file that asks for much: nothing is made of it.
TEST(ListStore, AFileThatAsksForTooMuchIsRefused) {
  ListLevels levels(1);
  const StoreScene big(floor_of(400));  // 320,000 triangles
  std::vector<std::uint32_t> all(big.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  levels[0].push_back({0, {RecordKind::list, 0, all, {}}});
  for (std::uint32_t i = 1; i < 1000; ++i) levels[0].push_back({0, {RecordKind::same, i - 1, {}, {}}});
  try {
    reference::decoded_levels(big.edges, levels);
    ADD_FAILURE() << "320 million triangles";
  } catch (const scene::Error& e) {
    EXPECT_EQ(e.code(), scene::ErrorCode::unsupported);
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
