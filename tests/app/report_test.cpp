// clues report: one page of what the other commands wrote.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string suite = std::string(CLUES_SOURCE_DIR) + "/vectors";

TEST(Report, ShowsAJudgementAndAConformanceRunWithPictures) {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path() / "results");
  std::filesystem::create_directory(folder.path() / "answers");
  folder.write("scene.off", screen_scene);
  folder.write("pvs.txt", "0\n1\n2\n3\n");
  folder.write("answers/groove-seen-from-its-end.txt", "0\n1\n");
  const auto check =
      run_clues({"check", "scene.off", "--cell", screen_cell, "--pvs", "pvs.txt", "--json"}, folder.path());
  ASSERT_EQ(check.exit_code, 1) << check.err;
  folder.write("results/town.json", check.out);
  const auto conform = run_clues({"conform", "--results", "answers", "--suite", suite, "--case",
                                  "groove-seen-from-its-end", "--json", "results/suite.json"},
                                 folder.path());
  ASSERT_EQ(conform.exit_code, 1) << conform.err;
  folder.write("results/other.json", "{\"format\": \"something else\"}");

  const auto ran = run_clues({"report", "results"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 results in results/report.html"));
  const std::string page = read_all(folder.file("results/report.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>suite.json</h2>"), HasSubstr("<h2>town.json</h2>")));
  EXPECT_THAT(page, AllOf(HasSubstr("<td>missing-visible</td><td>triangle 4</td>"), HasSubstr("<td>unsound</td>"),
                          HasSubstr("<option>loose</option>"), HasSubstr("overestimate Qo = 0.25, in area")));
  EXPECT_THAT(page, AllOf(HasSubstr("free sight line from ("), HasSubstr("missing: triangle 2, free sight line")));
  // Each of the two is shown in the page of `clues view`, or where this build has none, by a plan.
  const std::string table = page.substr(0, page.find("<div id=\"view\""));
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (auto at = table.find(words); at != std::string::npos; at = table.find(words, at + 1)) ++found;
    return found;
  };
  const bool has_view = table.size() < page.size();
  EXPECT_EQ(count("<svg"), has_view ? 0U : 2U);
  EXPECT_EQ(count("<button data-file="), has_view ? 2U : 0U);
  // Nothing is fetched: the one address is the name of the SVG format.
  EXPECT_THAT(table, AllOf(Not(HasSubstr("src=")), Not(HasSubstr("href=")), Not(HasSubstr("url("))));

  const auto again = run_clues({"report", "results", "-o", "again.html"}, folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_all(folder.file("again.html")), page);
}

TEST(Report, TextOfOthersIsNoMarkup) {
  const TestFolder folder;
  folder.write("<b>.off", screen_scene);
  folder.write("pvs.txt", "0\n1\n2\n4\n");
  const auto check =
      run_clues({"check", "<b>.off", "--cell", screen_cell, "--pvs", "pvs.txt", "--json"}, folder.path());
  ASSERT_EQ(check.exit_code, 0) << check.err;
  folder.write("town.json", check.out);
  ASSERT_EQ(run_clues({"report", "."}, folder.path()).exit_code, 0);
  EXPECT_THAT(read_all(folder.file("report.html")), AllOf(HasSubstr("&lt;b&gt;.off"), Not(HasSubstr("<b>"))));
}

TEST(Report, SaysWhatIsWrongAndWritesNothing) {
  const TestFolder folder;
  const auto nowhere = run_clues({"report", "nowhere"}, folder.path());
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("nowhere: there is no such folder"));
  const auto empty = run_clues({"report", "."}, folder.path());
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, HasSubstr("no results of"));
  folder.write("half.json", "{\"format\": \"clues-judgement/1\"}");
  const auto half = run_clues({"report", "."}, folder.path());
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_THAT(half.err, HasSubstr("half.json: is no complete result"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"half.json"});
}

}  // namespace
}  // namespace clues::tests
