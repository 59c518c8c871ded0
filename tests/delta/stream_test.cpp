// D25: streams of the server are sound on every transition and on long routes; wrong ones are caught, with step and
// sight line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include "fuzz/generators/random_scenes.h"
#include "reference/streams/stream_server.h"
#include "scene/messages/error.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/delta/town.h"
#include "tests/reference/support.h"
#include "tests/seed.h"
#include "validate/stream/judge_stream.h"

namespace clues::test {
namespace {

using scene::StreamMessage;
using Kind = StreamMessage::Kind;

TEST(Stream, CellsOfATownSeeDifferentTriangles) {
  std::set<std::vector<std::uint32_t>> different(town().lists().begin(), town().lists().end());
  EXPECT_GT(different.size(), 2U);
}

// What the client holds is a function of the cell. So all transitions, from all cells, are all routes of any length.
TEST(Stream, EveryTransitionIsSoundSoEveryRouteIs) {
  for (const int horizon : {0, 1, 2}) {
    for (std::uint32_t a = 0; a < town().neighbours().size(); ++a) {
      for (const std::uint32_t b : town().neighbours()[a]) {
        const auto verdict = town().judge(town().stream({a, b, a}, horizon));
        for (const auto& f : verdict.findings) ADD_FAILURE() << a << " to " << b << ": " << f.what;
        EXPECT_EQ(verdict.cells_entered, 3U);
        auto there = town().server(horizon), at_once = town().server(horizon);
        there.enter(a);
        there.enter(b);
        at_once.enter(b);
        EXPECT_EQ(there.mirror().triangles(), at_once.mirror().triangles());
      }
    }
  }
}

TEST(Stream, MirrorsStayEqualOnRandomRoutes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    auto server = town().server(static_cast<int>(seed % 3));
    validate::StreamClient client(town().mesh());
    for (const std::uint32_t cell : scene::random_route(town().neighbours(), 20, kSeed + seed)) {
      for (const auto& message : server.enter(cell)) {
        for (const auto& wrong : client.apply(message)) ADD_FAILURE() << wrong;
      }
      ASSERT_EQ(server.mirror().bytes(), client.bytes()) << "seed " << kSeed + seed;
    }
  }
}

TEST(Stream, RandomRoutesAreSound) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto route = scene::random_route(town().neighbours(), 20, kSeed + seed);
    const auto verdict = town().judge(town().stream(route, static_cast<int>(seed % 2)));
    for (const auto& f : verdict.findings) ADD_FAILURE() << f.what;
    EXPECT_EQ(verdict.cells_entered, 21U);
  }
}

// Ten scenes, grids in the middle of each, all transitions.
void expect_sound(std::uint64_t per_kind, const std::string& grid) {
  for (const fuzz::Kind kind : {fuzz::Kind::axis_boxes, fuzz::Kind::tetrahedra}) {
    for (std::uint64_t i = 0; i < per_kind; ++i) {
      const auto scene = fuzz::generate(kind, kSeed, i);
      SCOPED_TRACE(scene.name);
      const Town place(scene.mesh, grid);
      for (std::uint32_t a = 0; a < place.neighbours().size(); ++a) {
        for (const std::uint32_t b : place.neighbours()[a]) {
          for (const auto& f : place.judge(place.stream({a, b}, 0)).findings) ADD_FAILURE() << f.what;
        }
      }
    }
  }
}

TEST(StreamLong, OfTenScenesIsSoundOnEveryTransition) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  expect_sound(5, "grid:3x3x2:box:-3,-3,-2,3,3,2");
}

// The link is cut after every message, and a server that knows nothing of the session takes over: no hole, nothing twice.
TEST(Stream, IsTakenUpAfterACutAtEveryMessage) {
  for (const int horizon : {0, 1}) {
    const std::vector<std::uint32_t> route = scene::random_route(town().neighbours(), 20, kSeed);
    const auto whole = town().stream(route, horizon);
    for (std::size_t have = 0; have <= whole.size(); ++have) {
      auto other = town().server(horizon);
      std::vector<StreamMessage> joined(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(have));
      for (auto& message : other.resume(route, have)) joined.push_back(std::move(message));
      ASSERT_EQ(joined.size(), whole.size());
      EXPECT_EQ(other.messages(), whole.size());
      EXPECT_TRUE(town().judge(joined).findings.empty()) << "cut after " << have;
      // And the viewer goes on from there.
      for (auto& message : other.enter(town().neighbours()[route.back()][0])) joined.push_back(std::move(message));
      EXPECT_TRUE(town().judge(joined).findings.empty()) << "cut after " << have;
    }
    EXPECT_THROW(town().server(horizon).resume(route, whole.size() + 1), scene::Error);
  }
}

// A reconnection that begins anew, though the client has its list: everything comes twice.
TEST(Stream, AServerThatForgetsTheClientIsCaught) {
  const auto whole = town().stream({0, 1, 2}, 0);
  auto joined = whole;
  for (const auto& message : town().stream({2}, 0)) joined.push_back(message);
  EXPECT_FALSE(town().judge(joined).findings.empty());
}

// One wrong thing at a time, in a walk through all cells of the lower layer.
class PlantedStream : public ::testing::Test {
 protected:
  PlantedStream() : messages_(town().stream({0, 1, 2, 5, 4, 3, 6, 7, 8, 7, 4, 1, 0}, 0)) {}
  validate::StreamVerdict judge() const { return town().judge(messages_); }
  // The message of this kind that is not the first one, with something in it.
  StreamMessage& later(Kind kind) {
    return *std::find_if(messages_.begin() + 1, messages_.end(), [kind](const auto& m) { return m.kind == kind; });
  }
  bool has(Kind kind) {
    return std::any_of(messages_.begin() + 1, messages_.end(), [kind](const auto& m) { return m.kind == kind; });
  }
  // Found, by a step; and where something is missing, by a sight line.
  void expect_caught() const {
    const auto verdict = judge();
    ASSERT_FALSE(verdict.findings.empty());
    EXPECT_GT(verdict.findings[0].message, 0U);
  }
  void expect_caught_by_a_sight_line() const {
    const auto verdict = judge();
    EXPECT_TRUE(std::any_of(verdict.findings.begin(), verdict.findings.end(), [](const auto& f) { return f.witness; }));
  }

  std::vector<StreamMessage> messages_;
};

TEST_F(PlantedStream, TheRightOneIsSound) {
  EXPECT_TRUE(judge().findings.empty());
  EXPECT_TRUE(has(Kind::plus));
  EXPECT_TRUE(has(Kind::minus));
}

TEST_F(PlantedStream, OnePlusLost) {
  messages_.erase(messages_.begin() + (&later(Kind::plus) - messages_.data()));
  expect_caught();
  expect_caught_by_a_sight_line();
}

TEST_F(PlantedStream, OneTriangleOfAPlusLost) {
  messages_[0].plus.pop_back();
  expect_caught();
}

TEST_F(PlantedStream, PlusAndMinusExchanged) {
  for (auto& m : messages_) {
    if (m.kind != Kind::plus || &m == &messages_[0]) continue;
    StreamMessage turned;
    turned.kind = Kind::minus;
    for (const auto& t : m.plus) turned.minus.push_back(t.triangle);
    m = turned;
    break;
  }
  expect_caught();
  expect_caught_by_a_sight_line();
}

TEST_F(PlantedStream, TheMinusBeforeTheCell) {
  for (std::size_t i = 1; i + 1 < messages_.size(); ++i) {
    if (messages_[i].kind == Kind::cell && messages_[i + 1].kind == Kind::minus)
      std::swap(messages_[i], messages_[i + 1]);
  }
  expect_caught_by_a_sight_line();  // he still sees it from the cell that he leaves
}

TEST_F(PlantedStream, TheMinusOfTheWrongCell) {
  auto& minus = later(Kind::minus);
  const auto cell =
      std::find_if(messages_.rbegin(), messages_.rend(), [](const auto& m) { return m.kind == Kind::cell; });
  minus.minus = town().lists()[cell->cell];
  expect_caught();
}

// FIG. 45C: a count that is decremented too often frees a vertex that is used.
TEST_F(PlantedStream, AReferenceCountOneTooLow) {
  auto& minus = later(Kind::minus);
  const auto& stays = messages_[0].plus[0];
  minus.unused.push_back(stays.corners[0]);
  const auto verdict = judge();
  ASSERT_FALSE(verdict.findings.empty());
  EXPECT_NE(verdict.findings[0].what.find("unused"), std::string::npos);
}

TEST_F(PlantedStream, AReferenceCountOneTooHigh) {
  for (auto& m : messages_) {
    if (m.kind == Kind::minus && !m.unused.empty()) {
      m.unused.pop_back();
      break;
    }
  }
  expect_caught();
}

TEST_F(PlantedStream, APrefetchThatStopsEarly) {
  messages_ = town().stream({0, 1, 2, 5, 8}, 1);
  EXPECT_TRUE(judge().findings.empty());
  // All but the first cell's is cut off: the viewer goes on, and nothing comes.
  bool first = true;
  std::erase_if(messages_, [&](const auto& m) {
    const bool cut = m.kind == Kind::plus && !first;
    first = false;
    return cut;
  });
  expect_caught();
}

TEST_F(PlantedStream, ATriangleSentTwice) {
  StreamMessage again = messages_[0];
  again.vertices.clear();
  messages_.insert(messages_.begin() + 1, again);
  expect_caught();
}

TEST_F(PlantedStream, AStepThroughACorner) {
  messages_ = town().stream({0, 4}, 2);
  const auto verdict = judge();
  ASSERT_EQ(verdict.findings.size(), 1U);
  EXPECT_NE(verdict.findings[0].what.find("no neighbour"), std::string::npos);
}

TEST_F(PlantedStream, AVertexThatIsRounded) {
  messages_[0].vertices[0].at[0] += 1e-15;
  expect_caught();
}

TEST_F(PlantedStream, AVertexThatNoTriangleUses) {
  messages_[0].vertices.push_back({1000, {1, 2, 3}});
  const auto verdict = judge();
  ASSERT_FALSE(verdict.findings.empty());
  EXPECT_EQ(verdict.findings[0].message, 1U);
  EXPECT_EQ(verdict.findings[0].what, "slot 1000 is used by no triangle, and is not called unused");
}

// A client that looks at everything after each message.
class SlowClient {
 public:
  explicit SlowClient(const scene::TriangleMesh& mesh) : mesh_(&mesh) {}

  std::vector<std::string> apply(const StreamMessage& message) {
    std::vector<std::string> wrong;
    const bool plus = message.kind == Kind::plus;
    for (const auto& v : message.vertices) {
      if (v.slot == 0 || vertices_.contains(v.slot))
        wrong.push_back(fmt::format("a vertex is sent into slot {}, which is in use", v.slot));
      vertices_[v.slot] = v.at;
    }
    for (const auto& t : message.plus) {
      if (triangles_.contains(t.triangle)) {
        wrong.push_back(fmt::format("triangle {} is sent, and is there already", t.triangle));
        continue;
      }
      if (t.slot == 0 || slots_.contains(t.slot))
        wrong.push_back(fmt::format("triangle {} is sent into slot {}, which is in use", t.triangle, t.slot));
      slots_.insert(t.slot);
      triangles_[t.triangle] = t;
    }
    for (const std::uint32_t t : message.minus) {
      const auto at = triangles_.find(t);
      if (at == triangles_.end()) {
        wrong.push_back(fmt::format("triangle {} is taken away, and is not there", t));
        continue;
      }
      slots_.erase(at->second.slot);
      triangles_.erase(at);
    }
    for (const std::uint32_t slot : message.unused) {
      if (vertices_.erase(slot) == 0) wrong.push_back(fmt::format("slot {} is called unused, and is so already", slot));
    }
    std::set<std::uint32_t> used;
    for (const auto& [id, t] : triangles_) {
      bool right = true;
      for (std::size_t i = 0; i < 3; ++i) {
        used.insert(t.corners[i]);
        const auto at = vertices_.find(t.corners[i]);
        if (!plus && at == vertices_.end())
          wrong.push_back(fmt::format("slot {} is called unused, and triangle {} uses it", t.corners[i], id));
        const bool fits = at != vertices_.end() && at->second == mesh_->points[mesh_->triangles[id][i]];
        if (plus && right && !fits)
          wrong.push_back(fmt::format("corner {} of triangle {} is not that of the scene", i, id));
        right = right && fits;
      }
    }
    for (const auto& [slot, at] : vertices_) {
      if (!used.contains(slot))
        wrong.push_back(fmt::format("slot {} is used by no triangle, and is not called unused", slot));
    }
    return wrong;
  }

 private:
  const scene::TriangleMesh* mesh_;
  std::map<std::uint32_t, scene::StreamTriangle> triangles_;
  std::set<std::uint32_t> slots_;
  std::map<std::uint32_t, scene::Point> vertices_;
};

TEST(StreamClient, SaysOfAnyMessagesWhatASlowOneSays) {
  std::mt19937_64 random(kSeed);
  const auto& mesh = town().mesh();
  const auto below = [&random](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int session = 0; session < 50; ++session) {
    validate::StreamClient client(mesh);
    SlowClient slow(mesh);
    for (int step = 0; step < 30; ++step) {
      // Few triangles and slots, so that they collide; most corners are right.
      StreamMessage message;
      message.kind = below(2) == 0 ? Kind::plus : Kind::minus;
      for (std::uint32_t n = below(4); n > 0; --n) {
        const std::uint32_t t = below(4);
        if (message.kind == Kind::minus) {
          message.minus.push_back(t);
          message.unused.push_back(below(13));
          continue;
        }
        scene::StreamTriangle sent{t, below(6), {}};
        for (std::size_t i = 0; i < 3; ++i) {
          const std::uint32_t v = mesh.triangles[t][i];
          sent.corners[i] = below(8) == 0 ? below(13) : v + 1;
          if (below(3) > 0) message.vertices.push_back({sent.corners[i], mesh.points[v]});
        }
        message.plus.push_back(sent);
      }
      ASSERT_EQ(client.apply(message), slow.apply(message)) << "session " << session << ", step " << step;
    }
  }
}

TEST_F(PlantedStream, SlotZeroIsNothing) {
  messages_[0].plus[0].slot = 0;
  expect_caught();
}

TEST(Stream, TheDigestIsThatOfListsAndHorizon) {
  const reference::StreamStore same(town().mesh(), town().lists(), town().neighbours(), 1);
  EXPECT_EQ(town().store(1).digest(), same.digest());
  EXPECT_NE(town().store(0).digest(), same.digest());
  auto lists = town().lists();
  lists[0].pop_back();
  EXPECT_NE(reference::StreamStore(town().mesh(), lists, town().neighbours(), 1).digest(), same.digest());
}

}  // namespace
}  // namespace clues::test
