// clues fuzz, replay and shrink as a user runs them: exit codes, no progress in a pipe, and findings that stand on their own.
#include <gtest/gtest.h>

#include <algorithm>

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
  EXPECT_EQ(run_clues({"replay", finding, "--run-subject"}, folder.path()).exit_code, 1);
  EXPECT_EQ(run_clues({"replay", finding, "--subject", "reference"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"shrink", finding, "--run-subject", "--max-steps", "5"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"replay", finding, "--run-subject"}, folder.path()).exit_code, 1);
  std::string moved = read_all(finding + "/scene.off");
  folder.write("out/sight-lines-hidden-visible-loose_triangles/scene.off", moved + "\n");
  const Ran tampered = run_clues({"replay", finding}, folder.path());
  EXPECT_EQ(tampered.exit_code, 2);
  EXPECT_NE(tampered.err.find("scene.off"), std::string::npos) << tampered.err;
}

// A finding becomes a proved case of a suite; where that cannot be, the suite stays as it was.
TEST(FuzzCommand, PromotesAFindingToACaseOfASuite) {
  const TestFolder folder;
  const std::string out = folder.file("out"), suite = folder.file("suite");
  ASSERT_EQ(run_clues({"fuzz", "--subject", "sh -c ': > {pvs}'", "--cases", "1", "--errors", "1", "--oracle",
                       "sight-lines", "--out", out},
                      folder.path())
                .exit_code,
            1);
  std::filesystem::create_directory(suite);
  std::filesystem::copy_file(std::string(CLUES_SOURCE_DIR) + "/vectors/needles.json", suite + "/needles.json");
  ASSERT_EQ(run_clues({"lint", suite, "--write"}, folder.path()).exit_code, 0);
  const std::string finding = out + "/sight-lines-hidden-visible-loose_triangles";
  EXPECT_EQ(run_clues({"replay", finding, "--promote", suite}, folder.path()).exit_code, 2);  // no id
  EXPECT_EQ(
      run_clues({"replay", finding, "--run-subject", "--promote", suite, "--id", "No slug"}, folder.path()).exit_code,
      2);
  EXPECT_FALSE(std::filesystem::exists(suite + "/found.json"));
  const Ran promoted =
      run_clues({"replay", finding, "--run-subject", "--promote", suite, "--id", "first-find"}, folder.path());
  EXPECT_EQ(promoted.exit_code, 1) << promoted.err;  // reproduced
  const std::string found = read_all(suite + "/found.json"), index = read_all(suite + "/index.json");
  EXPECT_NE(found.find("\"must_be_visible\""), std::string::npos);
  EXPECT_NE(index.find("first-find"), std::string::npos);
  EXPECT_EQ(run_clues({"lint", suite}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"replay", finding, "--run-subject", "--promote", suite, "--id", "first-find"}, folder.path())
                .exit_code,
            2);
  EXPECT_EQ(read_all(suite + "/found.json"), found);
  EXPECT_EQ(run_clues({"replay", finding, "--run-subject", "--promote", suite, "--id", "second-find"}, folder.path())
                .exit_code,
            1);
  EXPECT_EQ(run_clues({"lint", suite}, folder.path()).exit_code, 0);
}

TEST(FuzzCommand, SaysWhatNeverOccurred) {
  const TestFolder folder;
  const std::vector<std::string> command{"fuzz", "--cases", "1", "--out", folder.file("out")};
  const Ran brief = run_clues(command, folder.path());
  EXPECT_EQ(brief.exit_code, 0) << brief.out << brief.err;
  EXPECT_TRUE(brief.out.starts_with("1 case of ")) << brief.out;
  EXPECT_NE(brief.out.find("; nothing found yet; run "), std::string::npos) << brief.out;
  EXPECT_EQ(std::count(brief.out.begin(), brief.out.end(), '\n'), 1) << brief.out;
  auto strict = command;
  strict.emplace_back("--require-coverage");
  const Ran ran = run_clues(strict, folder.path());
  EXPECT_EQ(ran.exit_code, 3) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("NEVER OCCURRED: cases of axis_boxes"), std::string::npos) << ran.out;
}

// As the help says it, without a shell of its own around the command.
TEST(FuzzCommand, TakesPlaceholdersAsTheyAre) {
  const TestFolder folder;
  folder.write("bake", "#!/bin/sh\nseq 0 $(( $(sed -n 2p \"$1\" | cut -d' ' -f2) - 1 )) > \"$4\"\n");
  std::filesystem::permissions(folder.file("bake"), std::filesystem::perms::owner_all);
  const Ran ran = run_clues({"fuzz", "--subject", "./bake {scene} {cell} -o {pvs}", "--generator", "loose_triangles",
                             "--cases", "2", "--time", "10m"},
                            folder.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_TRUE(ran.out.starts_with("2 cases of 1 generator's 100; nothing found yet; ")) << ran.out;
}

TEST(FuzzCommand, BadUsage) {
  const TestFolder folder;
  const std::string out = folder.file("out");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"fuzz", "--generator", "none", "--cases", "1", "--out", out},
           {"fuzz", "--oracle", "none", "--cases", "1", "--out", out},
           {"fuzz", "--cases", "0", "--out", out},
           {"fuzz", "--time", "20x", "--out", out},
           {"fuzz", "--time", "0", "--out", out},
           {"fuzz", "--subject", "bake {scene} | sort", "--cases", "1", "--out", out},
           {"fuzz", "--jobs", "0", "--out", out},
           {"fuzz", "--cases", "1", "--out", "/proc/nowhere"},
           {"fuzz", "--generator", "umbrellas:8", "--cases", "1", "--out", out},
           {"fuzz", "--generator", "mesh_pieces", "--cases", "1", "--out", out},
           {"fuzz", "--scenes", folder.file("none.off"), "--cases", "1", "--out", out},
           {"replay", folder.file("nothing")},
           {"shrink", folder.file("nothing")}}) {
    const Ran ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << words[1] << " " << words.back();
    EXPECT_FALSE(ran.err.empty());
    EXPECT_LT(ran.err.size(), 300U) << ran.err;
  }
  EXPECT_EQ(run_clues({"fuzz", "--help"}, folder.path()).exit_code, 0);
}

// The subject interrupts the campaign, as Ctrl-C would, and then answers: the case is finished and kept.
TEST(FuzzCommand, SaysWhatCtrlCWaitsFor) {
  const TestFolder folder;
  folder.write(
      "subject.sh",
      "q=$PPID\n"
      "while [ \"$(cut -d' ' -f2 /proc/$q/stat)\" = '(clues)' ]; do p=$q; q=$(cut -d' ' -f4 /proc/$q/stat); done\n"
      "kill -INT $p\n"
      "awk 'NR == 2 { for (i = 0; i < $2; ++i) print i }' \"$1\" > \"$2\"\n");
  const auto ran = run_clues({"fuzz", "--subject", "sh subject.sh {scene} {pvs}", "--generator", "cell_contacts",
                              "--oracle", "cell-contact", "--cases", "1000", "--out", "out"},
                             folder.path());
  EXPECT_EQ(ran.exit_code, 3) << ran.err;
  EXPECT_THAT(ran.err, testing::HasSubstr("clues: interrupted: finishing what is begun; once more, and that is lost"));
  EXPECT_THAT(ran.out, testing::HasSubstr("1 case of 1 generator's 100; nothing found yet"));
}

}  // namespace
}  // namespace clues::tests
