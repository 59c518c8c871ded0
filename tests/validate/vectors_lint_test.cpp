// Lint: the good suite passes, and every planted defect is found, as what it is.
#include "validate/vectors/lint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/validate/vectors_support.h"
#include "validate/vectors/reader.h"

namespace clues::validate {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;
using tests::SuiteFolder;

LintReport lint(const SuiteFolder& suite, const LintOptions& options = {}) { return lint_suite(suite.path(), options); }

// The findings of a suite with one changed expectation, as text.
std::string findings_with(const std::function<void(ordered_json&)>& change) {
  const SuiteFolder suite;
  suite.spoil([&](auto& file) { change(file["cases"][0]["expect"]); });
  const auto report = lint(suite);
  EXPECT_FALSE(report.findings.empty());
  for (const auto& finding : report.findings) EXPECT_EQ(finding.kind, LintKind::wrong);
  return to_text(report);
}

TEST(Lint, AGoodSuiteHasNoFindings) {
  const SuiteFolder suite;
  const auto report = lint(suite);
  EXPECT_TRUE(report.findings.empty()) << to_text(report);
  EXPECT_EQ(report.proved, 1U);
  EXPECT_EQ(report.proofs.witnesses, 4U);
  EXPECT_EQ(report.proofs.cell_contacts, 1U);
  EXPECT_EQ(report.proofs.umbra_by_map, 1U);
  EXPECT_GE(report.proofs.oracle_points, 10U);
  EXPECT_TRUE(report.written.empty());
}

TEST(Lint, AWrongWitnessIsFound) {
  const char* const where = "expect.must_be_visible, triangle 0: no witness";
  EXPECT_THAT(findings_with([](auto& e) {
                e["must_be_visible"][0]["p"] = {"0", "-1", "4"};
              }),
              HasSubstr(where));  // behind the screen
  EXPECT_THAT(findings_with([](auto& e) { e["must_be_visible"][0]["p"] = {"10", "-15", "5"}; }), HasSubstr(where));
  EXPECT_THAT(findings_with([](auto& e) {
                e["must_be_visible"][0]["v"] = {"0", "0", "0"};
              }),
              HasSubstr(where));  // on the rim
  EXPECT_THAT(findings_with([](auto& e) { e["must_be_visible"][0]["front"] = false; }), HasSubstr(where));
}

TEST(Lint, TheWitnessOfAnotherTriangleIsFound) {
  EXPECT_THAT(findings_with([](auto& e) { e["must_be_visible"][0]["p"] = e["must_be_visible"][1]["p"]; }),
              HasSubstr("expect.must_be_visible, triangle 0: no witness"));
}

TEST(Lint, AFractionThatIsNotInLowestTermsIsFound) {
  EXPECT_THAT(findings_with([](auto& e) { e["must_be_visible"][0]["v"][2] = "-2/16"; }), HasSubstr("lowest terms"));
}

TEST(Lint, AVisibleTriangleCalledUmbraIsFound) {
  const auto text = findings_with([](auto& e) {
    e["must_be_visible"].erase(3);
    e["umbra"].push_back({{"triangle", 4}, {"proof", "first_order_map"}});
  });
  EXPECT_THAT(text, HasSubstr("expect.umbra, triangle 4: is visible: free sight line"));
}

TEST(Lint, AWrongKindOfProofIsFound) {
  EXPECT_THAT(findings_with([](auto& e) { e["umbra"][0]["proof"] = "exhaustive"; }), HasSubstr("outside Omega"));
}

TEST(Lint, AHiddenTriangleCalledVisibleIsFound) {
  const auto text = findings_with([](auto& e) {
    e["umbra"].clear();
    const ordered_json seen{{"triangle", 3}, {"front", true}, {"v", {"0", "0", "-1/8"}}, {"p", {"0", "0", "9/4"}}};
    e["must_be_visible"].insert(e["must_be_visible"].begin() + 3, seen);
  });
  EXPECT_THAT(text, HasSubstr("expect.must_be_visible, triangle 3: no witness"));
}

TEST(Lint, WrongContactsAreFound) {
  EXPECT_THAT(findings_with([](auto& e) {
                e["must_be_visible"][0] = {{"triangle", 0}, {"meets_cell", true}};
              }),
              HasSubstr("triangle 0: does not meet the cell"));
  EXPECT_THAT(findings_with([](auto& e) {
                e["must_be_visible"][4] = {
                    {"triangle", 5}, {"front", true}, {"v", {"0", "0", "-1/16"}}, {"p", {"-1", "1/4", "-1/8"}}};
              }),
              HasSubstr("triangle 5: meets the cell"));
}

TEST(Lint, WrongSurfacesAreFound) {
  EXPECT_THAT(findings_with([](auto& e) {
                e["no_surface"] = ordered_json::array();
                e["umbra"].push_back({{"triangle", 6}, {"proof", "first_order_map"}});
              }),
              HasSubstr("expect.no_surface: without area are exactly [6]"));
}

TEST(Lint, AWrongFirstOrderSetIsFound) {
  EXPECT_THAT(findings_with([](auto& e) { e["first_order_visible"].push_back(6); }),
              HasSubstr("exactly [0, 1, 2, 4, 5]"));
}

// A limit makes a map larger (D17): where all that it lists is seen nothing was lost. The scene is Found.ANotchInAGroove.
TEST(Lint, ACaseThatIsCutShortIsTooHardUnlessAllThatIsListedIsSeen) {
  const auto groove = [](bool all_seen) {
    return [all_seen](ordered_json& file) {
      auto& scene = *file["scenes"].begin();
      scene["vertices"] = {
          {"-0x1p+1", "0x0p+0", "0x0p+0"},    {"0x0p+0", "0x0p+0", "0x0p+0"},      {"-0x1.7p-2", "0x1p+0", "0x1p+0"},
          {"0x1p+1", "0x0p+0", "0x0p+0"},     {"0x1.ap-1", "0x1p+0", "0x1p+0"},    {"-0x1.5p-1", "-0x1p+0", "0x1p+0"},
          {"-0x1.58p+0", "0x1p-3", "0x1p-1"}, {"-0x1.48p+0", "-0x1p-3", "0x1p-1"}, {"-0x1.58p+0", "0x0p+0", "0x1p-2"}};
      scene["triangles"] = {{0, 1, 2}, {1, 3, 4}, {0, 3, 5}, {6, 7, 8}};
      auto& only = file["cases"][0];
      only["cell"] = {{"-0x1p+0", "-0x1p+0", "0x0p+0"},
                      {"-0x1p+0", "0x1p+0", "0x0p+0"},
                      {"0x1p+0", "-0x1p+0", "0x0p+0"},
                      {"0x1p+0", "0x1p+0", "0x0p+0"}};
      auto seen = ordered_json::array();
      for (int t = 0; t < 3; ++t) seen.push_back({{"triangle", t}, {"meets_cell", true}});
      if (all_seen) {
        seen.push_back({{"triangle", 3},
                        {"front", true},
                        {"v", {"4354/4729", "1280/4729", "0"}},
                        {"p", {"-10625/8032", "-1/2008", "209/502"}}});
      }
      auto hidden = ordered_json::array();
      if (!all_seen)
        hidden.push_back({{"triangle", 3}, {"proof", "exhaustive"}});  // it is not: the finding beside ours
      only["expect"] = {{"must_be_visible", seen},
                        {"umbra", hidden},
                        {"no_surface", ordered_json::array()},
                        {"first_order_visible", {0, 1, 2, 3}}};
    };
  };
  const SuiteFolder suite;
  suite.spoil(groove(true));
  EXPECT_TRUE(lint(suite).findings.empty()) << to_text(lint(suite));
  suite.spoil(groove(false));
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("cut short by the generation limit (D17): too hard to be a case"));
}

TEST(Lint, MalformedFilesAreFoundAndTheOthersStillProved) {
  for (const auto& change : std::vector<std::function<void(ordered_json&)>>{
           [](auto& file) { file["cases"][0]["colour"] = "red"; },            // an unknown field
           [](auto& file) { file["cases"][0]["expect"]["umbra"].clear(); },   // a missing triangle
           [](auto& file) { file["cases"].push_back(file["cases"][0]); }}) {  // an id twice
    const SuiteFolder suite;
    suite.put("panes.json", suite.text("screens.json"));
    suite.spoil([](auto& file) { file["topic"] = "panes"; }, "panes.json");
    suite.spoil([](auto& file) { file["cases"][0]["id"] = "other"; }, "panes.json");
    suite.spoil(change);
    const auto report = lint(suite);
    EXPECT_EQ(report.proved, 1U);
    ASSERT_FALSE(report.findings.empty());
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(),
                            [](const auto& f) { return f.kind == LintKind::malformed; }));
  }
}

TEST(Lint, AnIdInTwoFilesIsFound) {
  const SuiteFolder suite;
  std::string text = suite.text("screens.json");
  text.replace(text.find("\"screens\""), 9, "\"panes\"");
  suite.put("panes.json", text);
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("is also in"));
}

TEST(Lint, UnformattedFilesAreFound) {
  const SuiteFolder suite;
  suite.put("screens.json", suite.text("screens.json") + "\n");
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("screens.json: is not in the canonical form"));
  suite.put("screens.json", ordered_json::parse(suite.text("screens.json")).dump());
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("screens.json: is not in the canonical form"));
  LintOptions write;
  write.write = true;
  EXPECT_TRUE(lint(suite, write).findings.empty());
  EXPECT_TRUE(lint(suite).findings.empty());
}

TEST(Lint, AVanishedIdIsFoundAndWriteDoesNotForgetIt) {
  const SuiteFolder suite;
  suite.spoil([](auto& file) { file["cases"][0]["id"] = "renamed"; });
  LintOptions write;
  write.write = true;
  for (const auto& options : {LintOptions{}, write, LintOptions{}}) {
    EXPECT_THAT(to_text(lint(suite, options)), HasSubstr("case screen-hides-what-is-right-behind: has vanished"));
  }
  // Withdrawn with a reason it may go.
  auto index = ordered_json::parse(suite.text("index.json"));
  auto& entry = index["cases"]["screen-hides-what-is-right-behind"];
  entry["status"] = "withdrawn";
  entry["reason"] = "renamed";
  suite.put("index.json", index.dump());
  EXPECT_TRUE(lint(suite, write).findings.empty());
  EXPECT_TRUE(lint(suite).findings.empty());
  // Its id does not come back.
  suite.spoil([](auto& file) { file["cases"][0]["id"] = "screen-hides-what-is-right-behind"; });
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("ids are not used again"));
}

TEST(Lint, WrongCountsAreFound) {
  for (const char* field : {"active", "withdrawn"}) {
    const SuiteFolder suite;
    auto index = ordered_json::parse(suite.text("index.json"));
    index[field] = 7;
    suite.put("index.json", index.dump(2));
    EXPECT_THAT(to_text(lint(suite)), HasSubstr("the counts do not agree"));
  }
}

TEST(Lint, WriteFillsInWhatIsMissing) {
  const SuiteFolder suite;
  suite.spoil([](auto& file) { file["cases"][0].erase("expect"); });
  std::filesystem::remove(suite.path() / "index.json");
  EXPECT_THAT(to_text(lint(suite)), HasSubstr("expect: is missing"));
  LintOptions write;
  write.write = true;
  const auto report = lint(suite, write);
  EXPECT_TRUE(report.findings.empty()) << to_text(report);
  EXPECT_EQ(report.written.size(), 2U);
  const auto again = lint(suite);
  EXPECT_TRUE(again.findings.empty()) << to_text(again);
  EXPECT_EQ(again.proofs.witnesses, 4U);
  EXPECT_EQ(read_suite(suite.path()).size(), 1U);
}

TEST(Lint, WriteChangesNoExpectationSilently) {
  const SuiteFolder suite;
  suite.spoil([](auto& file) { file["cases"][0]["expect"]["must_be_visible"][0]["p"] = {"0", "-1", "4"}; });
  const std::string before = suite.text("screens.json");
  LintOptions options;
  options.write = true;
  const auto refused = lint(suite, options);
  EXPECT_FALSE(refused.findings.empty());
  EXPECT_THAT(to_text(refused), HasSubstr("would be replaced with --accept"));
  EXPECT_EQ(suite.text("screens.json"), before);
  options.accept = true;
  EXPECT_TRUE(lint(suite, options).findings.empty());
  const auto kept = read_suite(suite.path())[0].expect->must_be_visible;
  EXPECT_EQ(kept[3].p[0], "37/4");  // a good witness is kept
  EXPECT_TRUE(lint(suite).findings.empty());
}

TEST(Lint, TheGlobChoosesWhatIsProved) {
  const SuiteFolder suite;
  suite.spoil([](auto& file) { file["cases"][0]["expect"]["first_order_visible"].push_back(6); });
  LintOptions options;
  options.glob = "window-*";
  const auto report = lint(suite, options);
  EXPECT_EQ(report.selected, 0U);
  EXPECT_TRUE(report.findings.empty());
}

TEST(Lint, SameReportForAnyNumberOfJobs) {
  const SuiteFolder suite;
  suite.spoil([](auto& file) {
    for (int i = 0; i < 5; ++i) {
      auto c = file["cases"][0];
      c["id"] = "copy-" + std::to_string(i);
      c["expect"]["first_order_visible"].push_back(6);
      file["cases"].push_back(c);
    }
  });
  const std::string one = to_json_text(lint(suite));
  LintOptions options;
  options.jobs = 3;
  EXPECT_EQ(to_json_text(lint(suite, options)), one);
  EXPECT_EQ(ordered_json::parse(one)["format"], "clues-lint/1");
}

}  // namespace
}  // namespace clues::validate
