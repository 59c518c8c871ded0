// clues query, clues map --umbra and clues verify, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class Commands : public testing::Test {
 protected:
  TestFolder folder_;
  Commands() { folder_.write("scene.off", screen_scene); }
  Ran run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, {"scene.off", "--cell", screen_cell});
    return run_clues(arguments, folder_.path());
  }
};

using Query = Commands;

TEST_F(Query, AnswersEachPointWithAProof) {
  folder_.write("points.txt", "0 0 -0.125\n0 1/64 5/2  # behind the screen\n");
  const auto table = run({"query", "--points", "points.txt"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("the point is in the cell"), HasSubstr("the cell is covered by triangle 2")));
  const auto ran = run({"query", "--points", "points.txt", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const auto answer = json::parse(ran.out);
  EXPECT_EQ(answer["format"], "clues-query/1");
  ASSERT_EQ(answer["points"].size(), 2U);
  EXPECT_EQ(answer["points"][0]["place"], "cell");
  EXPECT_EQ(answer["points"][1]["place"], "space");
  EXPECT_EQ(answer["points"][1]["line"], 2);
  EXPECT_EQ(answer["points"][1]["point"], json({"0", "1/64", "5/2"}));
  EXPECT_EQ(answer["points"][1]["answers"][0]["covered_by"], json({2}));
  EXPECT_EQ(answer["points"][1]["answers"][0]["first_order"], "hidden");
}

TEST_F(Query, CutsSegments) {
  folder_.write("points.txt", "0 0 0 0 0 3\n");
  const auto table = run({"query", "--points", "points.txt"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out,
              AllOf(HasSubstr("0 to 2/3"), HasSubstr("is seen from"), HasSubstr("no point is first-order visible")));
  const auto answer = json::parse(run({"query", "--points", "points.txt", "--json"}).out);
  ASSERT_EQ(answer["segments"].size(), 1U);
  EXPECT_EQ(answer["segments"][0]["parts"][0]["sight"], "visible");
  EXPECT_EQ(answer["segments"][0]["parts"][0]["to"], "2/3");
  EXPECT_EQ(answer["segments"][0]["parts"][1]["sight"], "hidden");
}

TEST_F(Query, BadPointsAreNamedByFileAndLine) {
  folder_.write("points.txt", "0 0 1\n0 0\n");
  const auto ran = run({"query", "--points", "points.txt"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: points.txt:2"), HasSubstr("three coordinates")));
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(run({"query", "--points", "not-there.txt"}).exit_code, 2);
  EXPECT_EQ(run({"query"}).exit_code, 2);
}

// Scenes in which a campaign found false answers of the checkers for cells without an interior (D3, D6).
class ThinCells : public testing::Test {
 protected:
  TestFolder folder_;
  Ran run(const std::string& command, const std::string& cell, std::vector<std::string> more) const {
    more.insert(more.begin(), {command, "scene.off", "--cell", cell});
    return run_clues(more, folder_.path());
  }
};

TEST_F(ThinCells, APointSeenPastATriangleThatCrossesTheLineOfASegmentCell) {
  folder_.write("scene.off", "OFF\n3 1 0\n-0.5 -1 0.5\n-0.5 1 0.5\n3.25 0 -1\n3 0 1 2\n");
  folder_.write("points.txt", "0.5 0 1\n");
  const auto ran = run("query", "box:0,0,0,1,0,0", {"--points", "points.txt", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(json::parse(ran.out)["points"][0]["answers"][0]["sight"], "visible") << ran.out;
}

TEST_F(ThinCells, AnEmptyUmbraHidesNoTriangleThatTouchesAFlatCell) {
  folder_.write("scene.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  folder_.write(
      "empty.json",
      R"({"format":"clues-umbra/1","bounds_exact":[["0","0","0"],["0","0","0"]],"vertices_exact":[],"facets":[]})");
  const auto ran = run("verify", "box:.25,.25,0,.5,.5,0", {"--umbra", "empty.json", "--list"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("hidden triangles: 0 of 1\n"));
}

// An open triangle that is turned away is no solid: asked for fronts only, it was called hidden.
TEST_F(ThinCells, SolidModeWantsASolid) {
  folder_.write("scene.off", "OFF\n3 1 0\n0 0 2\n0 2 2\n2 0 2\n3 0 1 2\n");
  folder_.write(
      "empty.json",
      R"({"format":"clues-umbra/1","bounds_exact":[["0","0","0"],["0","0","0"]],"vertices_exact":[],"facets":[]})");
  const auto ran = run("verify", "box:0,0,0,1,1,1", {"--umbra", "empty.json", "--solid", "--list"});
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
}

// Triangle 2 is seen from the line, or the point, at which the two others stand on the cell, and from nowhere
// else.
TEST_F(ThinCells, WhatIsSeenFromBetweenTrianglesOnTheCellAloneIsHidden) {
  const auto agree = [&](const char* scene, const std::string& cell) {
    folder_.write("scene.off", scene);
    ASSERT_EQ(run("map", cell, {"-o", "out.pvs"}).exit_code, 0);
    EXPECT_THAT(read_all(folder_.file("out.pvs")), testing::Not(HasSubstr("\n2\n")));
    const auto ran = run("check", cell, {"--pvs", "out.pvs"});
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("verdict: sound"));
    folder_.write("points.txt", "1/2 1/100 1\n");  // on triangle 2
    const auto asked = run("query", cell, {"--points", "points.txt", "--json"});
    EXPECT_EQ(asked.exit_code, 0) << asked.err;
    const json answers = json::parse(asked.out)["points"][0]["answers"];
    EXPECT_FALSE(answers.empty());
    for (const auto& answer : answers) EXPECT_EQ(answer["sight"], "occluded");
  };
  agree(
      "OFF\n9 3 0\n-1 0 0\n3 0 0\n1 -40 0.5\n-1 0 0\n3 0 0\n1 40 0.5\n0.4 -0.1 1\n0.6 -0.1 1\n0.5 0.2 1\n"
      "3 0 1 2\n3 3 4 5\n3 6 7 8\n",
      "box:0,-1,0,1,1,0");
  agree(
      "OFF\n9 3 0\n0.125 -1 0.5\n0.125 1 0.5\n1.25 0 -1\n0.875 -1 0.5\n0.875 1 0.5\n-0.25 0 -1\n"
      "0.4375 -0.0625 1\n0.5625 -0.0625 1\n0.5 0.0625 1\n3 0 1 2\n3 3 4 5\n3 6 7 8\n",
      "box:0,0,0,1,0,0");
}

using Umbra = Commands;

TEST_F(Umbra, IsWrittenAndVerified) {
  const auto ran = run({"map", "--umbra", "u.json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("certificate verified"));
  const auto umbra = json::parse(read_all(folder_.file("u.json")));
  EXPECT_EQ(umbra["format"], "clues-umbra/1");
  EXPECT_EQ(umbra["scene"]["file"], "scene.off");
  const auto verified = run({"verify", "--umbra", "u.json", "--list"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("hidden triangles: 1 of 5\n3\n"));
}

TEST_F(Umbra, TheSameBytesForEveryThreadCount) {
  ASSERT_EQ(run({"map", "--umbra", "one.json", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run({"map", "--umbra", "two.json", "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(read_all(folder_.file("one.json")), read_all(folder_.file("two.json")));
}

TEST_F(Umbra, AFaultIsAFinding) {
  ASSERT_EQ(run({"map", "--umbra", "u.json"}).exit_code, 0);
  const auto umbra = json::parse(read_all(folder_.file("u.json")));
  auto gap = umbra;
  gap["facets"].erase(0);
  folder_.write("gap.json", gap.dump());
  const auto open = run({"verify", "--umbra", "gap.json"});
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.out, HasSubstr("gap"));
  auto turned = umbra;
  for (auto& f : turned["facets"]) {
    if (f["kind"] == "wedge") std::swap(f["corners"][0], f["corners"][1]);
  }
  folder_.write("turned.json", turned.dump());
  const auto wrong = run({"verify", "--umbra", "turned.json"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.out, HasSubstr("on its outer side"));
  // A larger cell sees more: the same umbra is none for it.
  EXPECT_EQ(run_clues({"verify", "scene.off", "--cell", "box:-1,-1,-0.25,1,1,0", "--umbra", "u.json"}, folder_.path())
                .exit_code,
            1);
}

TEST_F(Umbra, BadFilesAreBadInput) {
  ASSERT_EQ(run({"map", "--umbra", "u.json"}).exit_code, 0);
  const auto umbra = json::parse(read_all(folder_.file("u.json")));
  const auto refused = [&](const json& changed, const char* mentions) {
    folder_.write("bad.json", changed.dump());
    const auto ran = run({"verify", "--umbra", "bad.json"});
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: bad.json"), HasSubstr(mentions)));
  };
  refused(json::array(), "format");
  auto bad = umbra;
  bad["format"] = "clues-result/1";
  refused(bad, "clues-umbra/1");
  bad = umbra;
  bad["scene"]["triangles"] = 6;
  refused(bad, "6 triangles");
  bad = umbra;
  bad["facets"][2]["corners"][1] = 100000;
  refused(bad, "facets[2]");
  bad = umbra;
  bad["vertices_exact"][1][2] = "1/0";
  refused(bad, "vertices_exact[1]");
  bad = umbra;
  bad["facets"][0]["kind"] = "wall";
  refused(bad, "facets[0]");
  folder_.write("cut.json", "{\"format\": ");
  EXPECT_EQ(run({"verify", "--umbra", "cut.json"}).exit_code, 2);
}

TEST_F(Umbra, RoundedFilesAndBounds) {
  ASSERT_EQ(run({"map", "--umbra", "u.off", "--bounds", "box:-8,-8,-1,8,8,8"}).exit_code, 0);
  EXPECT_THAT(read_all(folder_.file("u.off")), StartsWith("OFF\n"));
  ASSERT_EQ(run({"map", "--umbra", "u.ply"}).exit_code, 0);
  EXPECT_THAT(read_all(folder_.file("u.ply")), StartsWith("ply\n"));
  // A closed mesh: the program reads it as a scene in solid mode.
  EXPECT_EQ(run_clues({"map", "u.off", "--cell", screen_cell}, folder_.path()).exit_code, 0);
}

TEST_F(Umbra, BadOptionsWriteNothing) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--umbra", "u.txt"},
                                                  {"--bounds", "box:-9,-9,-9,9,9,9"},
                                                  {"--umbra", "u.json", "--bounds", "box:0,0,0,9,9,9"},
                                                  {"--umbra", "u.json", "--bounds", "box:-9,-9,0,9,9,0"},
                                                  {"--umbra", "u.json", "--bounds", "ball"},
                                                  {"--umbra", "nowhere/u.json"},
                                                  {"--render-states"}}) {
    std::vector<std::string> arguments{"map", "-o", "out.clues.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto ran = run(arguments);
    EXPECT_EQ(ran.exit_code, 2) << options.back();
    EXPECT_THAT(ran.err, StartsWith("clues: error: "));
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.off"});
  }
}

TEST_F(Commands, MapHoldsTheMeshAndOnRequestRenderStates) {
  const auto ran = run({"map", "--map", "--render-states", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto result = json::parse(ran.out);
  ASSERT_EQ(result["mesh"]["faces"].size(), result["regions"].size());
  for (const auto& edge : result["mesh"]["edges"]) EXPECT_EQ(edge["faces"].size(), edge["kind"] == "border" ? 1U : 2U);
  for (const auto& region : result["regions"]) {
    ASSERT_TRUE(region.contains("render_states"));
    EXPECT_TRUE(region["visible"] == true || region["render_states"].empty());
  }
  EXPECT_FALSE(json::parse(run({"map", "--map", "--json"}).out)["regions"][0].contains("render_states"));
}

}  // namespace
}  // namespace clues::tests
