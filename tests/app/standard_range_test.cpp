// Coordinates of any size: an answer or a refusal that names the vertex, never a crash and never "nan".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A normal of this triangle overflows. The fast kernel ended with a floating-point exception, the exact one
// said "-nan %".
constexpr const char* kBeyond = "v 5e160 -1e160 -1e160\nv 5e160 1e160 -1e160\nv 5e160 0 1e160\nf 1 2 3\n";
constexpr const char* kBeyondCell = "box:0,0,0,1e160,1e160,1e160";

TEST(CoordinatesOfAnySize, Beyond1e154) {
  const TestFolder folder;
  const std::string scene = folder.write("beyond.obj", kBeyond);
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {},
           {"--kernel", "fast"},
           {"--kernel", "fast", "--map", "--json"},
           {"--kernel", "fast", "--method", "subdivided", "--map"},
           {"--kernel", "fast", "--method", "backprojected", "--tolerance-area", "1"},
           {"--map", "--render-states", "--json"},
           {"--method", "subdivided", "--max-depth", "1"},
           {"--method", "backprojected", "--max-depth", "1"},
           {"--simplify-boundaries", "0.1", "--min-occlusion", "0.1", "--intersect-planes", "10"},
           {"--umbra", folder.file("umbra.json")}}) {
    std::vector<std::string> command{"map", scene, "--cell", kBeyondCell};
    command.insert(command.end(), more.begin(), more.end());
    SCOPED_TRACE(more.empty() ? "" : more.back());
    const Ran ran = run_clues(command, folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, Not(HasSubstr("nan")));
  }
  EXPECT_THAT(run_clues({"map", scene, "--cell", kBeyondCell}, folder.path()).out, HasSubstr("100.00 %"));
  const Ran verified =
      run_clues({"verify", scene, "--cell", kBeyondCell, "--umbra", folder.file("umbra.json")}, folder.path());
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST(CoordinatesOfAnySize, CheckQueryAndPrecisionBeyond1e154) {
  const TestFolder folder;
  const std::string scene = folder.write("beyond.obj", kBeyond), pvs = folder.write("all.pvs", "0\n"),
                    points = folder.write("points.txt", "5e160 0 0\n6e160 0 0\n2e160 0 0 7e160 0 0\n");
  for (const auto& [command, code] : std::vector<std::pair<std::vector<std::string>, int>>{
           {{"check", scene, "--cell", kBeyondCell, "--pvs", pvs}, 0},
           {{"check", scene, "--cell", kBeyondCell, "--pvs", pvs, "--json"}, 0},
           {{"check", scene, "--cell", kBeyondCell, "--pvs", folder.write("none.pvs", "")}, 1},
           {{"query", scene, "--cell", kBeyondCell, "--points", points}, 0},
           {{"precision", scene, "--cell", kBeyondCell, "--max-depth", "1", "--svg", folder.file("a.svg")}, 0},
           {{"precision", scene, "--cell", kBeyondCell, "--max-depth", "1", "--json"}, 0}}) {
    const Ran ran = run_clues(command, folder.path());
    EXPECT_EQ(ran.exit_code, code) << command.front() << ran.err;
    EXPECT_THAT(ran.out, Not(HasSubstr("nan"))) << command.front();
  }
  EXPECT_THAT(read_all(folder.file("a.svg")), Not(HasSubstr("nan")));
  // The same places in a scene of usual size.
  const std::string small = folder.write("small.obj", "v 5 -1 -1\nv 5 1 -1\nv 5 0 1\nf 1 2 3\n"),
                    there = folder.write("there.txt", "5 0 0\n6 0 0\n2 0 0 7 0 0\n");
  const auto words = [&](const std::string& of, const std::string& at, const std::string& cell) {
    const std::string out = run_clues({"query", of, "--cell", cell, "--points", at}, folder.path()).out;
    std::string found;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out.compare(i, 7, "visible") == 0) found += "v";
      if (out.compare(i, 8, "occluded") == 0) found += "o";
    }
    return found;
  };
  // Of the points. (5e160 is a double, and no multiple of 1e160: a segment has other parts there.)
  EXPECT_EQ(words(scene, points, kBeyondCell).substr(0, 3), "ovo");
  EXPECT_EQ(words(small, there, "box:0,0,0,1,1,1").substr(0, 3), "ovo");
}

TEST(CoordinatesOfAnySize, WhatCannotBeMovedExactlyIsRefused) {
  const TestFolder folder;
  const std::string scene = folder.write("wide.obj", "v 1e300 0 0\nv 0 1e300 0\nv 0 0 1e-300\nf 1 2 3\n");
  for (const char* kernel : {"exact", "fast"}) {
    const Ran ran =
        run_clues({"map", scene, "--cell", "box:1,1,1,2,2,2", "--kernel", kernel, "-o", folder.file("out.clues.json")},
                  folder.path());
    EXPECT_EQ(ran.exit_code, 2) << kernel;
    EXPECT_THAT(ran.err, AllOf(HasSubstr("vertex 2"), HasSubstr("1e-300"))) << kernel;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"wide.obj"});
  }
}

}  // namespace
}  // namespace clues::tests
