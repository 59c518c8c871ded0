// clues map, check and demo on good input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

TEST(Help, EveryCommandHasDescriptionExamplesAndExitCodes) {
  const TestFolder folder;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"map", "--help"},
                                                    {"precision", "--help"},
                                                    {"check", "--help"},
                                                    {"query", "--help"},
                                                    {"level", "--help"},
                                                    {"verify", "--help"},
                                                    {"report", "--help"},
                                                    {"demo", "--help"}}) {
    const auto ran = run_clues(arguments, folder.path());
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out, AllOf(HasSubstr("EXAMPLES"), HasSubstr("EXIT CODES")));
  }
}

TEST(Map, WritesTheVisibleTriangles) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const auto ran = run_clues({"map", "scene.off", "--cell", screen_cell, "-o", "out.clues.json"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const auto result = json::parse(read_all(folder.file("out.clues.json")));
  EXPECT_EQ(result["format"], "clues-result/1");
  EXPECT_EQ(result["visible"], json({0, 1, 2, 4}));
  EXPECT_EQ(result["scene"]["file"], "scene.off");
  EXPECT_FALSE(result.contains("regions"));
}

TEST(Map, PrintsATableOrTheResult) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const auto table = run_clues({"map", "scene.off", "--cell", screen_cell}, folder.path());
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("wholly"), HasSubstr(screen_cell)));
  const auto result = run_clues({"map", "scene.off", "--cell", screen_cell, "--json", "--map"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(json::parse(result.out).contains("regions"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.off"});
}

TEST(Map, PlainListByExtension) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  ASSERT_EQ(run_clues({"map", "scene.off", "--cell", screen_cell, "-o", "out.pvs"}, folder.path()).exit_code, 0);
  EXPECT_THAT(read_all(folder.file("out.pvs")), HasSubstr("0\n1\n2\n4\n"));
}

TEST(Map, RefinedMapsHoldTheVisibleTrianglesAndSayHowTheyWereMade) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  for (const auto& [arguments, method] :
       {std::pair<std::vector<std::string>, std::string>{{"--refine", "cell"}, "subdivided"},
        {{"--method", "subdivided"}, "subdivided"},
        {{"--method", "backprojected"}, "backprojected"},
        {{"--method", "backprojected", "--retract"}, "backprojected"},
        {{"--method", "subdivided", "--refine", "backprojection"}, "backprojected"},
        {{"--method", "backprojected", "--refine", "cell", "--tolerance-area", "0.5"}, "backprojected"}}) {
    for (const std::string kernel : {"exact", "fast"}) {
      if (kernel == "fast" && arguments.back() == "--retract") continue;
      std::vector<std::string> all{"map",   "scene.off", "--cell", screen_cell,   "--json",
                                   "--map", "--kernel",  kernel,   "--max-depth", "1"};
      all.insert(all.end(), arguments.begin(), arguments.end());
      const auto ran = run_clues(all, folder.path());
      ASSERT_EQ(ran.exit_code, 0) << ran.err;
      const auto result = json::parse(ran.out);
      EXPECT_EQ(result["method"], method);
      EXPECT_EQ(result["kernel"], kernel);
      EXPECT_EQ(result["visible"], json({0, 1, 2, 4}));
      EXPECT_TRUE(result.contains("regions"));
    }
  }
}

TEST(Map, TheFastKernelSaysWhatEachDepthGained) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const std::vector<std::string> command{"map",        "scene.off", "--kernel",    "fast", "--method",
                                         "subdivided", "--map",     "--max-depth", "2",    "--cell"};
  auto table = command;
  table.emplace_back(screen_cell);
  const auto ran = run_clues(table, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("witnessed"), HasSubstr("refined area"), HasSubstr("cells")));
  std::string first;
  for (const std::string threads : {"1", "3"}) {
    auto as_json = table;
    as_json.insert(as_json.end(), {"--json", "--threads", threads});
    const auto again = run_clues(as_json, folder.path());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    if (first.empty()) first = again.out;
    EXPECT_EQ(again.out, first) << threads;
  }
  const auto stats = json::parse(first)["stats"];
  EXPECT_EQ(stats["first_order_visible"], 4);
  EXPECT_EQ(stats["witnessed_visible"], 4);
  EXPECT_EQ(stats["refinement_step_00_visible"], 4);

  // Many cells: the same files as one by one.
  auto many = command;
  many.back() = "--cells";
  many.insert(many.end(), {"grid:2x1x1:" + std::string(screen_cell), "-o", "cells"});
  const auto cells = run_clues(many, folder.path());
  ASSERT_EQ(cells.exit_code, 0) << cells.err;
  const auto result = json::parse(read_all(folder.file("cells/cell-1-0-0.clues.json")));
  EXPECT_EQ(result["method"], "subdivided");
  EXPECT_EQ(result["kernel"], "fast");
}

TEST(Precision, ReportsTableJsonAndPicture) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const std::vector<std::string> command{"precision", "scene.off", "--cell", screen_cell, "--max-depth", "1"};
  const auto table = run_clues(command, folder.path());
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("witnessed"), HasSubstr("exactly known")));
  std::string first;
  for (const std::string threads : {"1", "3"}) {
    auto more = command;
    more.insert(more.end(), {"--json", "--threads", threads, "-o", "report.json", "--svg", "excess.svg"});
    const auto ran = run_clues(more, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    if (first.empty()) first = ran.out;
    EXPECT_EQ(ran.out, first) << threads;
  }
  const auto report = json::parse(first);
  EXPECT_EQ(read_all(folder.file("report.json")), first);
  EXPECT_EQ(report["format"], "clues-precision/1");
  EXPECT_EQ(report["depths"][0]["depth"], 0);
  EXPECT_GE(report["triangles"].size(), 4U);
  EXPECT_THAT(read_all(folder.file("excess.svg")), HasSubstr("<polyline"));
}

TEST(Map, SameBytesInEveryRunAndForEveryThreadCount) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  std::string first;
  for (const std::string threads : {"1", "2", "5", "1"}) {
    const auto ran =
        run_clues({"map", "scene.off", "--cell", screen_cell, "--json", "--map", "--threads", threads}, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    if (first.empty()) first = ran.out;
    EXPECT_EQ(ran.out, first) << threads;
  }
}

TEST(Map, TheTraversalGivesTheSameRegions) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  std::vector<json> results;
  for (const char* formulation : {"plain", "traversal"}) {
    const auto ran = run_clues(
        {"map", "scene.off", "--cell", screen_cell, "--formulation", formulation, "--map", "--json"}, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    results.push_back(json::parse(ran.out));
  }
  EXPECT_FALSE(results[0]["stats"].contains("traversal_surfaces_visited"));
  EXPECT_TRUE(results[1]["stats"].contains("traversal_surfaces_visited"));
  for (auto& result : results) result.erase("stats");
  EXPECT_EQ(results[0], results[1]);
  const auto ran = run_clues({"map", "scene.off", "--cell", screen_cell, "--formulation", "sideways"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, HasSubstr("use plain or traversal"));
}

TEST(Map, WritesTheOverlapGraph) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const auto ran = run_clues({"map", "scene.off", "--cell", screen_cell, "--overlap-graph", "out.dot"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(read_all(folder.file("out.dot")), AllOf(HasSubstr("digraph overlap"), HasSubstr(" -> ")));
  const auto many = run_clues(
      {"map", "scene.off", "--cells", "grid:1x1x1:box:0,0,0,1,1,1", "--overlap-graph", "many.dot"}, folder.path());
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"out.dot", "scene.off"}));
}

TEST(Map, ManyCellsMakeOneFileEachAndTheSameBytes) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const std::string cells = "grid:2x1x2:box:-1,-1,-1,1,1,0";
  for (const std::string threads : {"1", "3"}) {
    const auto ran = run_clues(
        {"map", "scene.off", "--cells", cells, "-o", "cells" + threads + "/", "--threads", threads}, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
  }
  for (const std::string name : {"cell-0-0-0", "cell-1-0-0", "cell-0-0-1", "cell-1-0-1"}) {
    const auto bytes = read_all(folder.file("cells1/" + name + ".clues.json"));
    EXPECT_THAT(bytes, HasSubstr("clues-result/1"));
    EXPECT_EQ(bytes, read_all(folder.file("cells3/" + name + ".clues.json")));
  }
}

TEST(Map, AStoppedRunOverManyCellsGoesOn) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const std::vector<std::string> command{"map", "scene.off", "--cells", "grid:2x1x1:box:-1,-1,-1,1,1,0", "-o", "cells"};
  auto resumed = command;
  resumed.push_back("--resume");
  ASSERT_EQ(run_clues(command, folder.path()).exit_code, 0);
  const auto first = folder.file("cells/cell-0-0-0.clues.json"), second = folder.file("cells/cell-1-0-0.clues.json");
  const auto whole = read_all(second);

  // What a kill leaves behind: one cell of two. The finished one is not made again.
  std::filesystem::remove(second);
  const auto kept = read_all(first);
  std::filesystem::create_hard_link(first, folder.file("kept"));
  const auto ran = run_clues(resumed, folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("1 of 2 cells"));
  EXPECT_EQ(read_all(first), kept);
  EXPECT_TRUE(std::filesystem::equivalent(first, folder.file("kept")));
  EXPECT_EQ(read_all(second), whole);

  // Neither a new run nor another question may mix its answers with these.
  const auto again = run_clues(command, folder.path());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--resume"));
  resumed.push_back("--map");
  const auto other = run_clues(resumed, folder.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("cells.json"));
  EXPECT_EQ(read_all(second), whole);
}

TEST(Map, TheFastKernelGivesTheSamePvs) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  const std::vector<std::string> command{"map", "scene.off", "--cell", screen_cell, "-o"};
  for (const auto& [kernel, out] : {std::pair{"exact", "exact.pvs"}, {"fast", "fast.pvs"}}) {
    auto arguments = command;
    for (const char* more : {out, "--kernel", kernel}) arguments.emplace_back(more);
    const auto ran = run_clues(arguments, folder.path());
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("fallbacks"));
  }
  EXPECT_EQ(read_all(folder.file("fast.pvs")), read_all(folder.file("exact.pvs")));

  const auto ran = run_clues({"map", "scene.off", "--cell", screen_cell, "--kernel", "fast", "--json"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto result = json::parse(ran.out);
  EXPECT_EQ(result["kernel"], "fast");
  EXPECT_EQ(result["stats"]["conservative_fallbacks"], 0);
}

TEST(Map, TheFastKernelRefusesWhatItCannotDo) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--umbra", "u.json"},
                                               {"--formulation", "traversal"},
                                               {"--map", "--render-states"},
                                               {"--min-occlusion", "1"},
                                               {"--simplify-boundaries", "0.1"},
                                               {"--overlap-graph", "g.dot"}}) {
    const auto ran = run_clues({"map", "scene.off", "--cell", screen_cell, "--kernel", "fast"}, more, folder.path());
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("--kernel exact"));
  }
}

TEST(Check, OwnPvsIsSound) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  for (const std::string out : {"out.clues.json", "out.pvs"}) {
    ASSERT_EQ(run_clues({"map", "scene.off", "--cell", screen_cell, "-o", out}, folder.path()).exit_code, 0);
    const auto ran = run_clues({"check", "scene.off", "--cell", screen_cell, "--pvs", out}, folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("verdict: sound"));
  }
}

TEST(Check, MissingVisibleTriangleIsUnsoundWithAWitness) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  folder.write("pvs.txt", "# triangle 4 forgotten\n0\n1\n2\n");
  const auto text = run_clues({"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt"}, folder.path());
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_THAT(text.out, AllOf(HasSubstr("verdict: unsound"), HasSubstr("missing although visible: 4\n"),
                              HasSubstr("sight line")));
  const auto ran =
      run_clues({"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt", "--json"}, folder.path());
  EXPECT_EQ(ran.exit_code, 1);
  const auto judgement = json::parse(ran.out);
  EXPECT_EQ(judgement["verdict"], "unsound");
  EXPECT_EQ(judgement["triangles"], json({"exact", "exact", "exact", "hidden", "missing-visible"}));
  bool found = false;
  for (const auto& witness : judgement["witnesses"]) found = found || witness["triangle"] == 4;
  EXPECT_TRUE(found);
}

TEST(Check, HiddenTriangleInTheListIsLoose) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  folder.write("pvs.txt", "0\n1\n2\n3\n4\n");
  const auto ran = run_clues({"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt"}, folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_THAT(ran.out,
              AllOf(HasSubstr("verdict: sound"), HasSubstr("1 loose"), HasSubstr("overestimate Qo = 0.25, in area"),
                    HasSubstr("underestimate Qu = 0, in area 0\n")));
}

TEST(Check, TriangleThatMeetsTheCellIsVisible) {
  const TestFolder folder;
  folder.write("scene.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("pvs.txt", "# nothing\n");
  const auto ran = run_clues({"check", "scene.off", "--cell", "box:0,0,0,1,1,1", "--pvs", "pvs.txt"}, folder.path());
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_THAT(ran.out, HasSubstr("triangle 0 meets the cell"));
}

TEST(Demo, NoMeshesSaysWhatToDoAndLeavesNothing) {
  const TestFolder folder;
  const auto ran = run_clues({"demo", "--quick", "--mesh-dir", "nowhere", "--out", "demo"}, folder.path());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("clues: error: "), HasSubstr("./run demo")));
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace clues::tests
