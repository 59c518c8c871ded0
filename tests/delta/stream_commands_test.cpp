// clues serve, walk and conform --stream as a user calls them.
#include <gtest/gtest.h>

#include "tests/app/program.h"
#include "tests/delta/town.h"

namespace clues::test {
namespace {

// The program as a server, and one that forgets what it sent.
TEST(StreamServers, TheProgramIsOne) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string cells = "grid:2x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0";
  const auto good =
      tests::run_clues({"conform", "--stream-server", std::string(CLUES_PROGRAM) + " serve screen.off --cells " + cells,
                        "--scene", "screen.off", "--cells", cells, "--steps", "6"},
                       folder.path());
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_NE(good.out.find("sound: 7 cells entered"), std::string::npos) << good.out;
  EXPECT_NE(good.out.find("it sent the rest each time"), std::string::npos) << good.out;
  EXPECT_NE(good.out.find("started anew after message 1, after message "), std::string::npos) << good.out;
  const auto none = tests::run_clues(
      {"conform", "--stream-server", "echo nothing", "--scene", "screen.off", "--cells", cells}, folder.path());
  EXPECT_EQ(none.exit_code, 1) << none.out << none.err;
}

// A box that all cells lie in, and that hides nothing from them in mode solid; in mode sheet it hides what is outside.
TEST(StreamCommands, SolidStreamsAreJudgedAsSolid) {
  const tests::TestFolder folder;
  SceneBuilder scene;
  scene.box({-1, -1, -1}, {1, 1, 1});
  scene.box({3, -1, -1}, {4, 1, 1});
  std::string off = fmt::format("OFF\n{} {} 0\n", scene.mesh().points.size(), scene.mesh().triangles.size());
  for (const auto& p : scene.mesh().points) off += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : scene.mesh().triangles) off += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  folder.write("boxes.off", off);
  const std::string cells = "grid:2x1x1:box:-0.5,-0.5,-0.5,0.5,0.5,0.5";
  const std::vector<std::string> walk{"walk", "boxes.off", "--cells", cells, "--steps", "2", "-o", "walk", "--mode"};
  const std::vector<std::string> judge{"conform", "--stream", "walk", "--scene", "boxes.off", "--cells", cells};
  for (const char* mode : {"sheet", "solid"}) {
    const auto walked = tests::run_clues(walk, {mode}, folder.path());
    ASSERT_EQ(walked.exit_code, 0) << walked.err;
    const auto judged = tests::run_clues(judge, folder.path());
    EXPECT_EQ(judged.exit_code, 0) << mode << judged.out << judged.err;
    EXPECT_EQ(judged.out.find("in mode solid") != std::string::npos, std::string(mode) == "solid") << judged.out;
  }
  // The same messages are not sound in the other mode.
  auto stream = scene::read_stream(folder.path() / "walk");
  EXPECT_EQ(stream.header.mode, "solid");
  stream.header.mode = "sheet";
  std::string text = scene::to_line(stream.header);
  for (const auto& message : stream.messages) text += scene::to_line(message);
  folder.write("walk", text);
  EXPECT_EQ(tests::run_clues(judge, folder.path()).exit_code, 1);
}

TEST(StreamCommands, AStreamOfOtherCellsIsRefused) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  ASSERT_EQ(tests::run_clues({"walk", "screen.off", "--cells", "grid:2x1x1:box:-0.25,-0.25,-0.25,0.25,0.25,0",
                              "--steps", "1", "-o", "walk"},
                             folder.path())
                .exit_code,
            0);
  const auto judged = tests::run_clues({"conform", "--stream", "walk", "--scene", "screen.off", "--cells",
                                        "grid:1x2x1:box:-0.25,-0.25,-0.25,0.25,0.25,0"},
                                       folder.path());
  EXPECT_EQ(judged.exit_code, 2) << judged.out;
  EXPECT_NE(judged.err.find("other cells"), std::string::npos) << judged.err;
}

TEST(StreamCommands, WhatIsNoNumberOrNoRouteIsBadUsage) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::vector<std::string> walk{
      "walk",      "screen.off", "--cells", "grid:2x1x1:box:-0.25,-0.25,-0.25,0.25,0.25,0",
      "--horizon", "1",          "--link",  "1000:1"};
  EXPECT_EQ(tests::run_clues(walk, {"--steps", "1", "--pace", "0.5", "--ahead", "0.5"}, folder.path()).exit_code, 0);
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{{"--steps", "1", "--pace", "nan"},
                                                                                   {"--steps", "1", "--ahead", "nan"},
                                                                                   {"--steps", "1", "--ahead", "inf"},
                                                                                   {"--steps", "1", "--ahead", "1.5"},
                                                                                   {"--steps", "0"},
                                                                                   {"--steps", "1000001"}}) {
    EXPECT_EQ(tests::run_clues(walk, bad, folder.path()).exit_code, 2) << bad.back();
  }
  const auto contours = tests::run_clues({"delta", "contours", "screen.off", "--parent", tests::screen_cell, "--cells",
                                          "grid:1x1x1:box:-0.1,-0.1,-0.1,0.1,0.1,0", "--reach", "nan"},
                                         folder.path());
  EXPECT_EQ(contours.exit_code, 2) << contours.out;
}

}  // namespace
}  // namespace clues::test
