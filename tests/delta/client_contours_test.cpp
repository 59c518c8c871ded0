// FIG. 54: contours that tell the client what of a node's list each cell sees. He draws the cell's list and no more, never
// less whatever else he holds, and a contour that leaves out what is visible is caught by a sight line.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "reference/streams/cell_tree.h"
#include "reference/streams/client_contours.h"
#include "scene/messages/error.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/seed.h"

namespace clues::test {
namespace {

using Kind = scene::StreamMessage::Kind;
using Said = std::vector<scene::StreamMessage>;

reference::StreamStore contour_store(std::size_t levels, int horizon) {
  reference::StreamStore store(town().mesh(), town().lists(), town().neighbours(), horizon,
                               reference::cell_tree(town().cells(), levels));
  store.add_contours();
  return store;
}

Said said_on(const reference::StreamStore& store, const std::vector<std::uint32_t>& route) {
  reference::StreamServer server(store);
  Said all;
  for (const std::uint32_t cell : route) {
    for (auto& message : server.enter(cell)) all.push_back(std::move(message));
  }
  return all;
}

std::vector<std::uint32_t> drawn_by(const validate::StreamClient& client, std::uint32_t cell) {
  const auto drawn = client.drawn_in(cell);
  EXPECT_TRUE(drawn) << "no contour for cell " << cell;
  return drawn ? std::vector<std::uint32_t>(drawn->begin(), drawn->end()) : std::vector<std::uint32_t>();
}

std::uint64_t count_of(const Said& messages, Kind kind) {
  return static_cast<std::uint64_t>(
      std::count_if(messages.begin(), messages.end(), [kind](const auto& m) { return m.kind == kind; }));
}

TEST(ClientContours, EachCellDrawsItsListAndNoMore) {
  for (const std::size_t levels : {0U, 2U, 3U}) {
    for (const int horizon : {0, 1}) {
      const auto store = contour_store(levels, horizon);
      for (std::uint32_t a = 0; a < town().neighbours().size(); ++a) {
        for (const std::uint32_t b : town().neighbours()[a]) {
          const Said all = said_on(store, {a, b});
          EXPECT_TRUE(town().judge(all).findings.empty()) << a << " to " << b;
          EXPECT_EQ(count_of(all, Kind::contours), store.coarsest_node(a) == store.coarsest_node(b) ? 1U : 2U);
          validate::StreamClient client(town().mesh());
          for (const auto& message : all) EXPECT_TRUE(client.apply(message).empty());
          EXPECT_EQ(drawn_by(client, b), store.seen_from(b)) << a << " to " << b;
        }
      }
    }
  }
}

// Whatever else he holds: all that the cell sees, with more triangles perhaps more.
TEST(ClientContours, WhoHoldsMoreDrawsNoLess) {
  const auto store = contour_store(3, 0);
  const auto triangles = static_cast<std::uint32_t>(town().mesh().triangles.size());
  std::mt19937_64 random(kSeed);
  for (std::uint32_t cell = 0; cell < town().lists().size(); ++cell) {
    for (int i = 0; i < 20; ++i) {
      std::set<std::uint32_t> held(store.seen_from(cell).begin(), store.seen_from(cell).end());
      for (std::uint32_t t = 0; t < triangles; ++t) {
        if (i == 0 || random() % 2 == 0) held.insert(t);
      }
      validate::StreamClient client(town().mesh());
      reference::DisplayList list(town().mesh());
      client.apply(list.plus({held.begin(), held.end()}));
      scene::StreamMessage contours;
      contours.kind = Kind::contours;
      contours.contours = store.contours_of_node(store.coarsest_node(cell));
      client.apply(contours);
      const auto drawn = drawn_by(client, cell);
      EXPECT_TRUE(
          std::includes(drawn.begin(), drawn.end(), store.seen_from(cell).begin(), store.seen_from(cell).end()));
    }
  }
}

TEST(ClientContours, AreTakenUpAnywhere) {
  const auto store = contour_store(2, 1);
  EXPECT_NE(store.digest(), reference::StreamStore(town().mesh(), town().lists(), town().neighbours(), 1).digest());
  const auto route = scene::random_route(town().neighbours(), 20, kSeed);
  const Said all = said_on(store, route);
  EXPECT_TRUE(town().judge(all).findings.empty());
  for (std::size_t have = 0; have <= all.size(); ++have) {
    reference::StreamServer other(store);
    const auto rest = other.resume(route, have);
    ASSERT_EQ(rest.size(), all.size() - have);
    for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(scene::to_line(rest[i]), scene::to_line(all[have + i]));
  }
}

TEST(ClientContours, ComeBackAsTheyWereWritten) {
  const auto store = contour_store(2, 0);
  const Said all = said_on(store, scene::random_route(town().neighbours(), 10, kSeed));
  std::string bytes = scene::to_packet(town().header());
  for (const auto& message : all) bytes += scene::to_packet(message);
  const auto packets = scene::parse_packets(bytes, "x");
  ASSERT_EQ(packets.messages.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(packets.messages[i].contours, all[i].contours);
    const auto line = scene::parse_stream_message(scene::to_line(all[i]), "x", town().header());
    EXPECT_EQ(line.kind, all[i].kind);
    EXPECT_EQ(line.contours, all[i].contours);
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      EXPECT_LT(scene::parse_packets(bytes.substr(0, size), "x").messages.size(), all.size());
    } catch (const scene::Error& e) {
      EXPECT_EQ(e.code(), scene::ErrorCode::malformed);
    }
  }
}

TEST(ClientContours, WhatIsNoneIsRefused) {
  const scene::StreamHeader header{"abc", "grid", 10, 2};
  EXPECT_EQ(
      scene::parse_stream_message(R"({"contours": [[0, [9], [0, 29]], [1, [], []]]})", "x", header).contours.size(),
      2U);
  for (const char* bad :
       {R"({"contours": 3})", R"({"contours": [[0, []]]})", R"({"contours": [[0, [], 1]]})",
        R"({"contours": [[2, [], []]]})", R"({"contours": [[1, [], []], [0, [], []]]})",
        R"({"contours": [[0, [], []], [0, [], []]]})", R"({"contours": [[0, [10], []]]})",
        R"({"contours": [[0, [3, 3], []]]})", R"({"contours": [[0, [], [30]]]})", R"({"contours": [[0, [], [2, 1]]]})",
        R"({"contours": [[0, [-1], []]]})", R"({"contours": [], "cell": 0})"})
    EXPECT_THROW(scene::parse_stream_message(bad, "x", header), scene::Error) << bad;

  // In packets: cell 0 with seeds and edges in a text.
  const auto packet = [](std::uint32_t cells, const std::vector<std::pair<std::uint32_t, std::string>>& contours) {
    std::string body;
    const auto put = [&body](std::uint64_t x) {
      for (int i = 0; i < 4; ++i) body.push_back(static_cast<char>(x >> (8 * i) & 0xff));
    };
    put(cells);
    for (const auto& [cell, text] : contours) {
      put(cell);
      put(text.size());
      body += text;
    }
    return scene::Packet{6, body};
  };
  using namespace std::string_literals;
  const auto read = [&](const scene::Packet& p) { return scene::parse_server_packet(p, "x", header).message; };
  const auto good = read(packet(1, {{1, "\1\3\2\1\0"s}}));
  ASSERT_EQ(good.contours.size(), 1U);
  EXPECT_EQ(good.contours[0], (scene::CellContour{1, {3}, {1, 2}}));
  for (const auto& bad : {packet(1, {}), packet(2, {{0, "\0\0"s}}), packet(1, {{2, "\0\0"s}}), packet(1, {{0, "\0"s}}),
                          packet(1, {{0, "\0\0\0"s}}), packet(1, {{0, "\1\12\0"s}}), packet(1, {{0, "\0\1\36"s}}),
                          packet(1, {{0, "\2\11\0\0"s}}), packet(2, {{1, "\0\0"s}, {0, "\0\0"s}}),
                          packet(2, {{1, "\0\0"s}, {1, "\0\0"s}}), packet(0, {{0, "\0\0"s}})})
    EXPECT_THROW(read(bad), scene::Error);
}

// Wrong contours. Each is given at the end of a session in the cell.
class PlantedContours : public ::testing::Test {
 protected:
  PlantedContours() : store_(contour_store(3, 0)) {}

  // How many of the wrong contours of this cell are caught: by a sight line, and of a triangle that is there.
  std::pair<std::uint64_t, std::uint64_t> caught(const std::vector<scene::CellContour>& wrong) const {
    std::uint64_t found = 0, shown = 0;
    for (const auto& contour : wrong) {
      Said all = said_on(store_, {contour.cell});
      scene::StreamMessage message;
      message.kind = Kind::contours;
      message.contours = {contour};
      all.push_back(message);
      const auto verdict = town().judge(all);
      found += verdict.findings.empty() ? 0U : 1U;
      shown += std::any_of(verdict.findings.begin(), verdict.findings.end(),
                           [](const auto& f) {
                             return f.witness && f.what.find("its contour leaves it out") != std::string::npos;
                           })
                   ? 1U
                   : 0U;
    }
    return {found, shown};
  }
  scene::CellContour contour_of(std::uint32_t cell) const {
    for (const auto& contour : store_.contours_of_node(store_.coarsest_node(cell))) {
      if (contour.cell == cell) return contour;
    }
    return {};
  }
  // The contours of all cells, without one of these.
  template <class Number>
  std::vector<scene::CellContour> each_less(std::vector<Number> scene::CellContour::*numbers) const {
    std::vector<scene::CellContour> wrong;
    for (std::uint32_t cell = 0; cell < town().lists().size(); ++cell) {
      const auto right = contour_of(cell);
      for (std::size_t i = 0; i < (right.*numbers).size(); ++i) {
        auto& less = wrong.emplace_back(right).*numbers;
        less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    return wrong;
  }

  reference::StreamStore store_;
};

TEST_F(PlantedContours, ASeedLess) {
  const auto wrong = each_less(&scene::CellContour::seeds);
  ASSERT_GT(wrong.size(), 20U);
  const auto [found, shown] = caught(wrong);
  EXPECT_EQ(found, wrong.size());  // each component has something visible
  EXPECT_EQ(shown, wrong.size());
}

TEST_F(PlantedContours, AnEdgeTooMany) {
  std::vector<scene::CellContour> wrong;
  for (std::uint32_t cell = 0; cell < town().lists().size(); ++cell) {
    for (const std::uint32_t t : store_.seen_from(cell)) {
      wrong.push_back(contour_of(cell));
      auto& boundary = wrong.back().boundary;
      for (std::uint64_t k = 0; k < 3; ++k) boundary.push_back(3 * std::uint64_t{t} + k);
      std::sort(boundary.begin(), boundary.end());
      boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
    }
  }
  EXPECT_GT(caught(wrong).second, 20U);  // those that are not seeds themselves
}

// Nothing visible is missing then; it only draws more.
TEST_F(PlantedContours, AnEdgeLess) {
  const auto wrong = each_less(&scene::CellContour::boundary);
  ASSERT_GT(wrong.size(), 4U);
  EXPECT_EQ(caught(wrong).first, 0U);
}

TEST_F(PlantedContours, ThatOfAnotherCell) {
  std::vector<scene::CellContour> wrong;
  for (std::uint32_t cell = 0; cell < town().lists().size(); ++cell) {
    for (const auto& other : store_.contours_of_node(store_.coarsest_node(cell))) {
      const auto &mine = store_.seen_from(cell), &others = store_.seen_from(other.cell);
      if (std::includes(others.begin(), others.end(), mine.begin(), mine.end())) continue;
      wrong.push_back(other);
      wrong.back().cell = cell;
    }
  }
  ASSERT_GT(wrong.size(), 5U);
  EXPECT_EQ(caught(wrong).second, wrong.size());
}

TEST(ContourCommands, WalkServeAndConformHaveThem) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string cells = "grid:4x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0";
  const auto walked = tests::run_clues({"walk", "screen.off", "--cells", cells, "--steps", "10", "--hierarchy", "2",
                                        "--contours", "--binary", "-o", "walk"},
                                       folder.path());
  ASSERT_EQ(walked.exit_code, 0) << walked.err;
  EXPECT_NE(walked.out.find("contours: "), std::string::npos) << walked.out;
  const auto judged =
      tests::run_clues({"conform", "--stream", "walk", "--scene", "screen.off", "--cells", cells}, folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_NE(judged.out.find(" contours, "), std::string::npos) << judged.out;
  for (const char* form : {"", " --binary"}) {
    const auto served = tests::run_clues(
        {"conform", "--stream-server",
         std::string(CLUES_PROGRAM) + " serve screen.off --hierarchy 2 --contours --cells " + cells + form, "--scene",
         "screen.off", "--cells", cells, "--steps", "6"},
        folder.path());
    EXPECT_EQ(served.exit_code, 0) << served.out << served.err;
  }
}

}  // namespace
}  // namespace clues::test
