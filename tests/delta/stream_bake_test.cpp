// Streams of the cells of a level: what a bake lists is there at every step, and where it is not, a sight line shows it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "exact/cell/touching.h"
#include "reference/streams/stream_server.h"
#include "scene/bakes/bake_store.h"
#include "scene/scenes/scene_io.h"
#include "scene/stream/route.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"
#include "tests/levels/real_levels.h"
#include "validate/stream/judge_stream.h"

namespace clues::test {
namespace {

using tests::run_clues;

std::string baked_level(const tests::TestFolder& folder) {
  folder.write("made.bsp", tests::two_rooms().bytes());
  const auto ran = run_clues({"bake", "made.bsp", "--cells", "leaves", "-o", "made.bake"}, folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  return "made.bake";
}

TEST(BakedStreams, OfALevelAreSound) {
  const tests::TestFolder folder;
  const std::string bake = baked_level(folder);
  const auto walked =
      run_clues({"walk", "made.bsp", "--bake", bake, "--steps", "20", "--horizon", "1", "-o", "walk"}, folder.path());
  ASSERT_EQ(walked.exit_code, 0) << walked.err;
  const std::vector<std::string> judge{"conform", "--stream", "walk", "--scene", "made.bsp", "--bake", bake};
  const auto sound = run_clues(judge, folder.path());
  EXPECT_EQ(sound.exit_code, 0) << sound.out << sound.err;
  EXPECT_NE(sound.out.find("sound: 21 cells entered"), std::string::npos) << sound.out;
  const auto served =
      run_clues({"conform", "--stream-server", std::string(CLUES_PROGRAM) + " serve made.bsp --binary --bake " + bake,
                 "--scene", "made.bsp", "--bake", bake, "--steps", "5"},
                folder.path());
  EXPECT_EQ(served.exit_code, 0) << served.out << served.err;

  // Nothing of the first message comes.
  auto stream = scene::read_stream(folder.path() / "walk");
  stream.messages.front().plus.clear();
  stream.messages.front().vertices.clear();
  std::string text = scene::to_line(stream.header);
  for (const auto& message : stream.messages) text += scene::to_line(message);
  folder.write("walk", text);
  const auto caught = run_clues(judge, folder.path());
  EXPECT_EQ(caught.exit_code, 1) << caught.out << caught.err;
  EXPECT_NE(caught.out.find("sight line from"), std::string::npos) << caught.out;
}

TEST(BakedStreams, ABakeOfAnotherSceneIsRefused) {
  const tests::TestFolder folder;
  const std::string bake = baked_level(folder);
  folder.write("screen.off", tests::screen_scene);
  const auto ran = run_clues({"walk", "screen.off", "--bake", bake, "--steps", "1"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("is of another scene"), std::string::npos) << ran.err;
}

// A level that nobody here made (real_levels.h), and its bake, or what CLUES_BAKES has of it.
TEST(BakedStreamsLong, AThousandRoutesThroughALevel) {
  if (!std::getenv("CLUES_LONG")) GTEST_SKIP() << "long: ./run test --long";
  const tests::TestFolder folder;
  const auto [levels, why_not] = tests::real_levels(folder);
  if (levels.empty()) GTEST_SKIP() << why_not;
  const std::filesystem::path level = levels / "fan.bsp";
  std::filesystem::path bake = folder.path() / "fan.bake";
  if (const char* bakes = std::getenv("CLUES_BAKES")) {
    bake = std::filesystem::path(bakes) / "fan.bake";
  } else {
    ASSERT_EQ(run_clues({"bake", level.string(), "--cells", "leaves", "-o", bake.string()}, folder.path()).exit_code,
              0);
  }
  const auto mesh = scene::read_scene(level).mesh;
  const scene::FinishedBake store(bake);
  std::vector<exact::ConvexCell> hulls;
  std::vector<std::vector<scene::Point>> corners;
  std::vector<std::vector<std::uint32_t>> lists;
  std::vector<validate::Judgement> truth;
  for (std::uint32_t c = 0; c < store.plan().cells.size(); ++c) {
    corners.push_back(store.plan().cells[c].points);
    hulls.push_back(exact::ConvexCell::from_doubles(corners.back()));
    lists.push_back(store.cell(c).list);
    truth.emplace_back();
    truth.back().triangles.assign(mesh.triangles.size(), validate::TriangleVerdict::hidden);
    for (const auto t : lists.back()) truth.back().triangles[t] = validate::TriangleVerdict::missing_visible;
  }
  const auto neighbours = exact::touching_cells(hulls);
  std::uint64_t entered = 0;
  // The last with a hierarchy and contours, and a level of it at random at each step.
  for (const auto& [horizon, tree_levels] : {std::pair(0, 0U), {1, 0U}, {0, 3U}}) {
    reference::StreamStore shared(mesh, lists, neighbours, horizon, reference::cell_tree(corners, tree_levels));
    if (tree_levels > 0) shared.add_contours();
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      reference::StreamServer server(shared);
      validate::StreamClient client(mesh);
      std::vector<scene::StreamMessage> all;
      std::mt19937_64 random(seed);
      for (const std::uint32_t cell :
           scene::random_route(neighbours, 20, seed, static_cast<std::uint32_t>(seed % lists.size()))) {
        for (auto& message : server.enter(cell, random() % (tree_levels + 1))) {
          client.apply(message);
          all.push_back(std::move(message));
        }
        if (seed > 50) continue;
        ASSERT_EQ(server.mirror().bytes(), client.bytes()) << "seed " << seed;
      }
      const auto verdict = validate::judge_stream(
          mesh, neighbours, all, [&](std::uint32_t c) -> const validate::Judgement& { return truth[c]; });
      for (const auto& f : verdict.findings) ADD_FAILURE() << "seed " << seed << ": " << f.what;
      entered += verdict.cells_entered;
    }
  }
  EXPECT_EQ(entered, 3U * 1000U * 21U);
}

}  // namespace
}  // namespace clues::test
