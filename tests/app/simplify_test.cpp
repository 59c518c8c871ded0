// clues map --min-occlusion and --simplify-boundaries (FIG. 30).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Simplify : public testing::Test {
 protected:
  Simplify() { folder_.write("scene.off", screen_scene); }

  Ran run(const std::vector<std::string>& more) const {
    return run_clues({"map", "scene.off", "--cell", screen_cell}, more, folder_.path());
  }
  json result(std::vector<std::string> more) const {
    more.emplace_back("--json");
    const auto ran = run(more);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return json::parse(ran.out);
  }

  TestFolder folder_;
};

// The screen's shadow on the wall goes. Triangle 3, behind the screen, stays hidden: that costs no segment.
TEST_F(Simplify, SaysWhatItGaveUpAndWhatItSaved) {
  const json plain = result({});
  EXPECT_FALSE(plain.contains("simplification"));
  const json simple = result({"--min-occlusion", "1e6", "--map"});
  EXPECT_EQ(simple["visible"], json({0, 1, 2, 4}));
  const json& said = simple["simplification"];
  EXPECT_EQ(said["min_occlusion"], 1e6);
  EXPECT_EQ(said["simplify_boundaries"], 0);
  EXPECT_GT(said["before"]["boundary_segments"], 0);
  EXPECT_EQ(said["after"]["boundary_segments"], 0);
  EXPECT_LT(said["after"]["hidden_area_estimate"], said["before"]["hidden_area_estimate"]);
  EXPECT_EQ(said["after"]["occlusion_regions"].get<int>(), said["before"]["occlusion_regions"].get<int>() - 1);
  EXPECT_EQ(said["after"]["visible_triangles"], 4);
  for (const auto& segment : simple["segments"]) EXPECT_FALSE(segment["boundary"].get<bool>());
  EXPECT_THAT(run({"--min-occlusion", "1e6"}).out,
              AllOf(HasSubstr("simplified: boundary segments"), HasSubstr("-> 0")));
  EXPECT_THAT(run({}).out, Not(HasSubstr("simplified")));
}

TEST_F(Simplify, NothingGivenUpChangesNothing) {
  json simple = result({"--min-occlusion", "0", "--simplify-boundaries", "0", "--map"});
  EXPECT_EQ(simple["simplification"]["before"], simple["simplification"]["after"]);
  simple.erase("simplification");
  EXPECT_EQ(simple, result({"--map"}));
}

TEST_F(Simplify, GoesWithEveryMethodAndFormulation) {
  for (const std::vector<std::string>& method : {std::vector<std::string>{"--method", "first-order"},
                                                 {"--formulation", "traversal"},
                                                 {"--method", "backprojected", "--max-depth", "1"},
                                                 {"--refine", "cell", "--max-depth", "1"},
                                                 {"--map", "--render-states"}}) {
    auto arguments = method;
    for (const char* more : {"--simplify-boundaries", "0.25", "--min-occlusion", "0.5"}) arguments.emplace_back(more);
    const json simple = result(arguments);
    EXPECT_EQ(simple["visible"], json({0, 1, 2, 4}));
    EXPECT_EQ(simple["method"], result(method)["method"]);
    EXPECT_GE(simple["simplification"]["after"]["hidden_area_estimate"].get<double>(),
              0.75 * simple["simplification"]["before"]["hidden_area_estimate"].get<double>());
  }
}

TEST_F(Simplify, TheSameBytesForEveryThreadCount) {
  const std::vector<std::string> command{"--simplify-boundaries", "0.5", "--map", "--json", "--threads"};
  auto one = command, two = command;
  one.emplace_back("1");
  two.emplace_back("2");
  EXPECT_EQ(run(one).out, run(two).out);
}

TEST_F(Simplify, ManyCellsRememberWhatWasAsked) {
  const std::vector<std::string> command{"map", "scene.off", "--cells",  std::string("grid:2x1x1:") + screen_cell,
                                         "-o",  "cells",     "--resume", "--simplify-boundaries"};
  auto first = command, other = command;
  first.emplace_back("0.5");
  other.emplace_back("0.25");
  const auto ran = run_clues(first, folder_.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(json::parse(read_all(folder_.file("cells/cell-0-0-0.clues.json"))).contains("simplification"));
  EXPECT_EQ(run_clues(first, folder_.path()).exit_code, 0);
  EXPECT_EQ(run_clues(other, folder_.path()).exit_code, 2);
}

TEST_F(Simplify, WhatIsOfTheWholeHiddenSpaceRefuses) {
  const auto ran = run({"--umbra", "u.json", "--min-occlusion", "1"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, HasSubstr("--umbra"));
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.off"});
}

}  // namespace
}  // namespace clues::tests
