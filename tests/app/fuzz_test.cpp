// clues fuzz, replay and shrink as a user runs them: exit codes, no progress in a pipe, and findings that stand on their own.
#include <gtest/gtest.h>

#include "program.h"

namespace clues::tests {
namespace {

using testing::Test;

TEST(FuzzCommand, FindsAProgramThatHidesEverything) {
  const TestFolder folder;
  const Ran ran = run_clues({"fuzz", "--subject", "sh -c ': > {pvs}'", "--cases", "1", "--errors", "1", "--oracle",
                             "sight-lines", "--out", folder.file("out")},
                            folder.path());
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_NE(ran.out.find("FINDING sight-lines hidden/visible loose_triangles"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.err.find('\r'), std::string::npos);
  const std::string finding = folder.file("out/sight-lines-hidden-visible-loose_triangles");
  EXPECT_EQ(run_clues({"replay", finding}, folder.path()).exit_code, 1);
  EXPECT_EQ(run_clues({"replay", finding, "--subject", "reference"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"shrink", finding, "--max-steps", "5"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"replay", finding}, folder.path()).exit_code, 1);
  std::string moved = read_all(finding + "/scene.off");
  folder.write("out/sight-lines-hidden-visible-loose_triangles/scene.off", moved + "\n");
  const Ran tampered = run_clues({"replay", finding}, folder.path());
  EXPECT_EQ(tampered.exit_code, 2);
  EXPECT_NE(tampered.err.find("scene.off"), std::string::npos) << tampered.err;
}

TEST(FuzzCommand, SaysWhatNeverOccurred) {
  const TestFolder folder;
  const Ran ran = run_clues({"fuzz", "--cases", "1", "--out", folder.file("out")}, folder.path());
  EXPECT_EQ(ran.exit_code, 3) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("NEVER OCCURRED: cases of axis_boxes"), std::string::npos) << ran.out;
}

TEST(FuzzCommand, BadUsage) {
  const TestFolder folder;
  const std::string out = folder.file("out");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"fuzz", "--generator", "none", "--cases", "1", "--out", out},
                                             {"fuzz", "--oracle", "none", "--cases", "1", "--out", out},
                                             {"fuzz", "--subject", "reference:none", "--cases", "1", "--out", out},
                                             {"fuzz", "--cases", "0", "--out", out},
                                             {"fuzz", "--jobs", "0", "--out", out},
                                             {"fuzz", "--cases", "1", "--out", "/proc/nowhere"},
                                             {"replay", folder.file("nothing")},
                                             {"shrink", folder.file("nothing")}}) {
    const Ran ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << words[1] << " " << words.back();
    EXPECT_FALSE(ran.err.empty());
  }
  EXPECT_EQ(run_clues({"fuzz", "--help"}, folder.path()).exit_code, 0);
}

}  // namespace
}  // namespace clues::tests
