// The command line of `clues conform`: selection, expected failures, reports, bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <filesystem>
#include <set>
#include <sstream>

#include "support.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string everything = planted("everything-visible");

std::set<std::string> ids(const Conformed& done) {
  std::set<std::string> found;
  for (const auto& [id, outcome] : done.outcomes) found.insert(id);
  return found;
}

using Ids = std::set<std::string>;

TEST(Selection, ByGlobFlagTopicAndLevel) {
  EXPECT_EQ(ids(conform({"--impl", everything, "--case", "gap-*", "--case", "wall-in-the-ope?"})),
            (Ids{"gap-of-zero", "gap-of-one-ulp", "wall-in-the-open"}));
  EXPECT_EQ(ids(conform({"--impl", everything, "--flag", "Slit", "--flag", "Rim"})),
            (Ids{"slit-off-centre", "two-crossed-slits", "seen-from-the-rim-of-the-cell-only"}));
  EXPECT_EQ(ids(conform({"--impl", everything, "--topic", "precision"})),
            (Ids{"gap-of-zero", "gap-of-one-ulp", "seen-from-the-rim-of-the-cell-only"}));
  EXPECT_EQ(ids(conform({"--impl", everything, "--topic", "precision", "--flag", "Rim"})),
            Ids{"seen-from-the-rim-of-the-cell-only"});
  EXPECT_EQ(ids(conform({"--impl", everything, "--level", "core"})).size(), 12U);
}

TEST(Selection, ShardsArePartsOfTheWhole) {
  Ids all;
  std::size_t sum = 0;
  for (const std::string shard : {"1/5", "2/5", "3/5", "4/5", "5/5"}) {
    const auto part = ids(conform({"--impl", everything, "--shard", shard}));
    sum += part.size();
    all.insert(part.begin(), part.end());
  }
  EXPECT_EQ(sum, 12U);
  EXPECT_EQ(all.size(), 12U);
}

TEST(Selection, NothingIsNoSuccess) {
  for (const auto& choice : {std::vector<std::string>{"--case", "no-such-case"},
                             {"--topic", "none"},
                             {"--flag", "None"},
                             {"--shard", "13/13"}}) {
    auto arguments = choice;
    arguments.insert(arguments.end(), {"--impl", everything});
    const auto done = conform(arguments);
    EXPECT_EQ(done.ran.exit_code, 3);
    EXPECT_THAT(done.ran.err, HasSubstr("nothing was executed"));
  }
}

TEST(Reports, AreTheSameForAnyNumberOfJobs) {
  const TestFolder folder;
  std::set<std::string> texts;
  for (const std::string jobs : {"1", "2", "7"}) {
    for (const std::string mode : {"hides-one", "answers-twice"}) {
      const auto ran = run_clues({"conform", "--suite", small_suite, "--impl", planted(mode), "-v", "--jobs", jobs,
                                  "--json", "r.json", "--junit", "r.xml"},
                                 folder.path());
      EXPECT_EQ(ran.exit_code, 1);
      EXPECT_EQ(ran.err, "");
      texts.insert(ran.out + read_all(folder.file("r.json")) + read_all(folder.file("r.xml")));
    }
  }
  EXPECT_EQ(texts.size(), 2U);
}

TEST(Reports, StopAtTheSameProblemForAnyNumberOfJobs) {
  std::set<std::string> texts;
  for (const std::string jobs : {"1", "3", "8"}) {
    const auto done = conform({"--impl", planted("from-centre"), "--errors", "25", "--jobs", jobs}, published_suite);
    EXPECT_EQ(done.ran.exit_code, 1);
    EXPECT_EQ(done.report["problems"], 25);
    EXPECT_GT(done.report["not_reached"], 0);
    texts.insert(done.ran.out + done.report.dump());
  }
  EXPECT_EQ(texts.size(), 1U);
}

TEST(Reports, JunitCountsWhatItHolds) {
  const TestFolder folder;
  run_clues({"conform", "--suite", small_suite, "--impl", planted("reads-float32"), "--junit", "sound.xml"},
            folder.path());
  run_clues({"conform", "--suite", small_suite, "--impl", planted("crashes", "gap-of-zero"), "--junit", "crash.xml"},
            folder.path());
  struct Expected {
    const char* file;
    int failures, skipped;
  };
  for (const auto& [file, failures, skipped] : {Expected{"sound.xml", 0, 3}, Expected{"crash.xml", 1, 0}}) {
    boost::property_tree::ptree document;
    boost::property_tree::read_xml(folder.file(file), document);
    int tests = 0, found_failures = 0, found_skipped = 0, said_failures = 0, said_skipped = 0;
    for (const auto& [name, suite] : document.get_child("testsuites")) {
      if (name != "testsuite") continue;
      said_failures += suite.get<int>("<xmlattr>.failures");
      said_skipped += suite.get<int>("<xmlattr>.skipped");
      for (const auto& [kind, test] : suite) {
        if (kind != "testcase") continue;
        ++tests;
        found_failures += static_cast<int>(test.count("failure"));
        found_skipped += static_cast<int>(test.count("skipped"));
      }
    }
    EXPECT_EQ(tests, 12);
    EXPECT_EQ(found_failures, failures);
    EXPECT_EQ(said_failures, failures);
    EXPECT_EQ(found_skipped, skipped);
    EXPECT_EQ(said_skipped, skipped);
  }
  EXPECT_THAT(read_all(folder.file("crash.xml")),
              AllOf(HasSubstr("Segmentation fault"), HasSubstr("about to crash"), HasSubstr("--case gap-of-zero")));
}

// The command that is printed does what it says.
TEST(Reports, TheRepeatCommandRepeatsTheCase) {
  const auto done = conform({"--impl", planted("hides-one"), "--case", "gap-of-zero"});
  const auto start = done.ran.out.find("  repeat: clues ");
  ASSERT_NE(start, std::string::npos);
  const auto command = done.ran.out.substr(start + 16, done.ran.out.find('\n', start) - start - 16);
  // Quoted for a shell, and one such word is there.
  EXPECT_THAT(command,
              AllOf(StartsWith("conform --suite "), HasSubstr("--impl '"), testing::EndsWith(" --case gap-of-zero")));
  const TestFolder folder;
  const auto script = folder.write("again.sh", "exec '" CLUES_PROGRAM "' " + command + "\n");
  const auto again = std::system(("sh '" + script + "' > '" + folder.file("out") + "'").c_str());
  EXPECT_EQ(WEXITSTATUS(again), 1);
  EXPECT_EQ(read_all(folder.file("out")), done.ran.out);
}

// ---- expected failures

std::string expectation(const std::string& id, const std::string& issue = "https://example.org/issues/1",
                        const std::string& date = "2026-11-21") {
  return R"({"case": ")" + id + R"(", "issue": ")" + issue + R"(", "date": ")" + date + "\"}";
}

std::string list_of(const std::string& cases) {
  return R"({"format": "clues-expected-failures/1", "cases": [)" + cases + "]}";
}

TEST(ExpectedFailures, ExcuseWhatTheyListAndNothingElse) {
  const TestFolder folder;
  const auto file = folder.write("expected.json", list_of(expectation("gap-of-zero")));
  const auto excused = conform({"--impl", planted("crashes", "gap-of-zero"), "--expect-failures", file});
  EXPECT_EQ(excused.ran.exit_code, 0) << excused.ran.out;
  EXPECT_EQ(excused.outcomes.at("gap-of-zero"), "crash");
  EXPECT_THAT(excused.ran.out, HasSubstr("1 failed as expected"));
  EXPECT_EQ(conform({"--impl", planted("crashes", "gap-of-one-ulp"), "--expect-failures", file}).ran.exit_code, 1);
}

TEST(ExpectedFailures, OneThatPassesIsAnError) {
  const TestFolder folder;
  const auto file = folder.write("expected.json", list_of(expectation("gap-of-zero")));
  const auto done = conform({"--impl", everything, "--expect-failures", file});
  EXPECT_EQ(done.ran.exit_code, 1);
  EXPECT_THAT(done.ran.out, AllOf(HasSubstr("PASSES gap-of-zero"), HasSubstr("https://example.org/issues/1")));
  // Not selected: neither passed nor failed.
  EXPECT_EQ(conform({"--impl", everything, "--expect-failures", file, "--case", "wall-*"}).ran.exit_code, 0);
}

TEST(ExpectedFailures, AreStrictlyRead) {
  const TestFolder folder;
  const auto good = expectation("gap-of-zero");
  struct Bad {
    std::string text;
    const char* says;
  };
  for (const auto& [text, says] :
       {Bad{"", "not JSON"}, Bad{"[]", "not an object"},
        Bad{R"({"format": "clues-expected-failures/2", "cases": []})", "clues-expected-failures/1"},
        Bad{list_of(expectation("no-such-case")), "no such case"}, Bad{list_of(good + "," + good), "twice"},
        Bad{list_of(expectation("gap-of-zero", "see the wiki")), "http"},
        Bad{list_of(expectation("gap-of-zero", "https://")), "http"},
        Bad{list_of(expectation("gap-of-zero", "https://x", "2026-02-30")), "not a day"},
        Bad{list_of(expectation("gap-of-zero", "https://x", "yesterday")), "not a day"},
        Bad{list_of(R"({"case": "gap-of-zero", "issue": "https://x"})"), "entry 0"},
        Bad{list_of(R"({"case": "gap-of-zero", "issue": "https://x", "date": "2026-11-21", "why": "?"})"),
            "entry 0"}}) {
    const auto file = folder.write("expected.json", text);
    const auto done = conform({"--impl", everything, "--expect-failures", file});
    EXPECT_EQ(done.ran.exit_code, 2) << text;
    EXPECT_THAT(done.ran.err, AllOf(StartsWith("clues: error: "), HasSubstr("expected.json"), HasSubstr(says)));
    EXPECT_EQ(done.ran.out, "");
  }
}

// ---- the suite itself

TEST(Suite, AProofThatDoesNotHoldIsAnErrorOfTheSuite) {
  const TestFolder folder;
  std::filesystem::copy(small_suite, folder.file("suite"));
  auto text = read_all(folder.file("suite/precision.json"));
  auto json = nlohmann::ordered_json::parse(text);
  for (auto& test : json["cases"]) {
    if (test["id"] == "gap-of-zero") test["expect"]["must_be_visible"][0]["p"][2] = "3";  // beside the triangle
  }
  folder.write("suite/precision.json", json.dump());
  const auto done = conform({"--impl", planted("everything-hidden")}, folder.file("suite"));
  EXPECT_EQ(done.ran.exit_code, 4) << done.ran.err;
  EXPECT_THAT(done.ran.out, HasSubstr("THE SUITE IS WRONG: gap-of-zero, triangle 0"));
}

// ---- bad usage

struct BadUsage {
  std::vector<std::string> arguments;
  const char* says;
};

TEST(BadUsage, ExitsWithTwoAndSaysWhy) {
  const TestFolder folder;
  folder.write("not-a-library.so", "text");
  folder.write("not-executable", "text");
  std::filesystem::create_directory(folder.file("empty"));
  for (const auto& [arguments, says] :
       std::vector<BadUsage>{{{}, "exactly one of --impl, --results and --export"},
                             {{"--impl", "true", "--results", "empty"}, "exactly one of"},
                             {{"--impl", "no-such-command-anywhere"}, "command not found"},
                             {{"--impl", folder.file("not-executable")}, "Permission denied"},
                             {{"--impl", ""}, "exactly one of"},
                             {{"--impl", "  "}, "not a command"},
                             {{"--impl", "true | false"}, "into a script"},
                             {{"--impl", "'unfinished"}, "not a command"},
                             {{"--impl", "$no_such_variable_anywhere"}, "not a command"},
                             {{"--impl", "true"}, "ended with exit status 0"},
                             {{"--impl", "false"}, "ended with exit status 1"},
                             {{"--impl", "echo hello"}, "'hello' is not JSON"},
                             {{"--impl", planted("other-protocol")}, "protocol 2"},
                             {{"--impl", "missing.so"}, "missing.so: no such file"},
                             {{"--impl", folder.file("not-a-library.so")}, "cannot be loaded as a shared library"},
                             {{"--impl", NO_FUNCTION_LIBRARY}, "has no function clues_iut_pvs"},
                             {{"--results", "no-such-folder"}, "no-such-folder: no such folder"},
                             {{"--export", "no/such/folder"}, "no/such/folder"},
                             {{"--impl", everything, "--shard", "0/3"}, "--shard 0/3"},
                             {{"--impl", everything, "--shard", "4/3"}, "--shard 4/3"},
                             {{"--impl", everything, "--shard", "1/"}, "--shard 1/"},
                             {{"--impl", everything, "--level", "all"}, "--level all"},
                             {{"--impl", everything, "--jobs", "-1"}, "--jobs -1"},
                             {{"--impl", everything, "--time-limit", "0"}, "--time-limit"},
                             {{"--impl", everything, "--time-limit", "nan"}, "--time-limit"},
                             {{"--impl", everything, "--errors", "-1"}, "--errors -1"},
                             {{"--impl", everything, "--memory-limit", "-1"}, "--memory-limit -1"},
                             {{"--impl", everything, "--expect-failures", "nowhere.json"}, "nowhere.json"},
                             {{"--impl", everything, "--junit", "no/such/report.xml"}, "no/such"},
                             {{"--impl", everything, "--suite", folder.file("empty")}, "empty"},
                             {{"--impl", everything, "--suite", "nowhere"}, "nowhere"},
                             {{"--impl", everything, "--bogus"}, "--bogus"}}) {
    const bool has_suite = std::find(arguments.begin(), arguments.end(), "--suite") != arguments.end();
    std::vector<std::string> words{"conform"};
    if (!has_suite) words.insert(words.end(), {"--suite", small_suite});
    words.insert(words.end(), arguments.begin(), arguments.end());
    const auto before = folder.names();
    const auto ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2) << says << ran.err;
    EXPECT_THAT(ran.err, AllOf(StartsWith("clues: error: "), HasSubstr(says)));
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(folder.names(), before);
  }
}

TEST(Iut, RefusesWhatIsNoRequest) {
  const TestFolder folder;
  for (const std::string line :
       {"hello", "{}", R"({"cmd":"start","protocol":2})", R"({"cmd":"run","seq":-1,"case":{}})",
        R"({"cmd":"start","protocol":1,"colour":"red"})"}) {
    const auto file = folder.write("requests", line + "\n");
    const auto status = std::system(("'" CLUES_PROGRAM "' iut --kernel exact < '" + file + "' > '" +
                                     folder.file("out") + "' 2> '" + folder.file("err") + "'")
                                        .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << line;
    EXPECT_THAT(read_all(folder.file("err")), HasSubstr("docs/protocol.md"));
  }
  EXPECT_EQ(run_clues({"iut"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run_clues({"iut", "--kernel", "quick"}, folder.path()).exit_code, 2);
}

TEST(Help, NamesEveryOptionAndOutcome) {
  const TestFolder folder;
  const auto help = run_clues({"conform", "--help"}, folder.path()).out;
  for (const char* word : {"--impl",           "--suite",        "--case",    "--flag",
                           "--topic",          "--level",        "--shard",   "--jobs",
                           "--time-limit",     "--memory-limit", "--errors",  "--expect-failures",
                           "--json",           "--junit",        "--verbose", "--results",
                           "--export",         "EXIT CODES",     "tight",     "conservative",
                           "unsound",          "unsupported",    "skipped",   "rejected_input",
                           "malformed_output", "errored",        "crash",     "timeout",
                           "resource"}) {
    EXPECT_THAT(help, HasSubstr(word));
  }
}

}  // namespace
}  // namespace clues::tests
