// clues lint from the command line: exit codes and outputs. What it finds is tested in tests/validate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// One triangle above the cell, without expectation.
constexpr const char* draft = R"({"format": "clues-vectors/1", "topic": "mine", "definition": "D6",
  "source": {"name": "me", "version": "2026-11", "seed": null, "confirmed_by": "the oracle"},
  "notes": {"Lone": {"bug_type": "METHOD", "description": "Nothing hides.", "effect": "None.", "hazards": []}},
  "scenes": {"lone": {"vertices": [["0x0p+0", "0x0p+0", "0x1p+1"], ["0x1p+0", "0x0p+0", "0x1p+1"], ["0x0p+0", "0x1p+0", "0x1p+1"]],
    "triangles": [[0, 1, 2]]}},
  "cases": [{"id": "lone-triangle-is-seen", "comment": "One triangle.", "flags": ["Lone"], "level": "core", "scene": "lone",
    "mode": "sheet", "cell": [["0x0p+0", "0x0p+0", "0x0p+0"], ["0x1p+0", "0x0p+0", "0x0p+0"], ["0x0p+0", "0x1p+0", "0x0p+0"],
      ["0x0p+0", "0x0p+0", "-0x1p+0"]]}]})";

TEST(LintCommand, FromDraftToProvedSuite) {
  const TestFolder folder;
  folder.write("mine.json", draft);
  const auto before = run_clues({"lint", "."}, folder.path());
  EXPECT_EQ(before.exit_code, 2);  // no index
  EXPECT_THAT(before.out, HasSubstr("there is no index"));
  const auto written = run_clues({"lint", ".", "--write"}, folder.path());
  EXPECT_EQ(written.exit_code, 0) << written.out << written.err;
  EXPECT_THAT(written.out, HasSubstr("expect filled in"));
  const auto after = run_clues({"lint", ".", "--json", "--jobs", "2"}, folder.path());
  EXPECT_EQ(after.exit_code, 0) << after.out;
  EXPECT_EQ(after.err, "");
  EXPECT_EQ(json::parse(after.out)["proved"], 1);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"index.json", "mine.json"}));
}

TEST(LintCommand, FindingsAndMalformedFilesHaveTheirOwnExitCodes) {
  const TestFolder folder;
  folder.write("mine.json", draft);
  ASSERT_EQ(run_clues({"lint", ".", "--write"}, folder.path()).exit_code, 0);
  const std::string good = read_all(folder.file("mine.json"));
  folder.write("mine.json", good + "\n");
  EXPECT_EQ(run_clues({"lint", "."}, folder.path()).exit_code, 1);
  folder.write("mine.json", good.substr(0, good.size() / 2));
  EXPECT_EQ(run_clues({"lint", "."}, folder.path()).exit_code, 2);
}

TEST(LintCommand, NothingProvedIsNoSuccess) {
  const TestFolder folder;
  folder.write("mine.json", draft);
  ASSERT_EQ(run_clues({"lint", ".", "--write"}, folder.path()).exit_code, 0);
  const auto none = run_clues({"lint", ".", "--case", "window-*"}, folder.path());
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no case matches"));
  const TestFolder empty;
  EXPECT_EQ(run_clues({"lint", "."}, empty.path()).exit_code, 2);
}

TEST(LintCommand, BadUsageIsNamed) {
  const TestFolder folder;
  const auto missing = run_clues({"lint", "nowhere"}, folder.path());
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("nowhere: no such folder"));
  folder.write("mine.json", draft);
  EXPECT_THAT(run_clues({"lint", ".", "--accept"}, folder.path()).err, HasSubstr("--accept goes with --write"));
  EXPECT_EQ(run_clues({"lint", ".", "--jobs", "-1"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace clues::tests
