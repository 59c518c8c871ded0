// A table of attacks on the conformance runner. Each cheat (planted/cheats.cpp) is put in the first or the last of three cases; what it would honestly
// be worth there is `unsound`, and no row is to be worth more, to be charged to another case, to leave a process behind, or to reach the terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "support.h"

namespace clues::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* first_case = "screen-hides-one-triangle";
constexpr const char* last_case = "gap-of-zero";

// Processes, other than this one, that were started with that word on their command line.
std::vector<std::string> processes_with(const std::string& word) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::string line;  // words end with NUL
    try {
      line = read_all(entry.path() / "cmdline");
    } catch (const std::ios_base::failure&) {
      continue;  // it has just ended
    }
    if (line.find(std::string(1, '\0') + word + '\0') != std::string::npos) found.push_back(entry.path().filename());
  }
  return found;
}

bool is_fit_for_a_terminal(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c == '\n' || c == '\t' || (c >= 0x20 && c < 0x7f); });
}

Conformed try_cheat(const std::string& mode, const std::string& id, const std::string& seconds) {
  const TestFolder folder;
  Conformed done;
  done.ran = run_clues({"conform", "--suite", small_suite, "--impl", planted(mode, id), "--case", first_case, "--case",
                        "wall-in-the-open", "--case", last_case, "--time-limit", seconds, "--json", "report.json"},
                       folder.path());
  if (fs::exists(folder.file("report.json"))) {
    done.report = nlohmann::json::parse(read_all(folder.file("report.json")));
    for (const auto& test : done.report["cases"]) done.outcomes[test["id"]] = test["outcome"];
  }
  if (mode != "everything-visible") {  // other tests may be about that one just now
    EXPECT_EQ(processes_with(mode), std::vector<std::string>()) << "outlived the run";
  }
  return done;
}

struct Cheat {
  const char* mode;
  const char* outcome;
  const char* says = "";
  enum { anywhere, at_first, at_last } place = anywhere;
  bool waits = false;  // for the end of its time
};

void PrintTo(const Cheat& cheat, std::ostream* out) { *out << cheat.mode; }

class CheatTest : public testing::TestWithParam<Cheat> {};

TEST_P(CheatTest, IsWorthNoMoreAndChargedToItsCase) {
  static const auto usual = try_cheat("everything-visible", "", "10").outcomes;
  ASSERT_EQ(usual.size(), 3U);
  const auto& cheat = GetParam();
  for (const std::string id : {first_case, last_case}) {
    if (cheat.place == (id == first_case ? Cheat::at_last : Cheat::at_first)) continue;
    const auto done = try_cheat(cheat.mode, id, cheat.waits ? "1" : "10");
    auto expected = usual;
    expected[id] = cheat.outcome;
    EXPECT_EQ(done.outcomes, expected) << done.ran.out;
    EXPECT_EQ(done.ran.exit_code, cheat.outcome == std::string("errored") ? 3 : 1);
    EXPECT_EQ(done.ran.err, "");
    EXPECT_THAT(done.ran.out, AllOf(HasSubstr(cheat.says), HasSubstr("\n3 cases: "), Not(HasSubstr("\n12 cases"))));
    EXPECT_TRUE(is_fit_for_a_terminal(done.ran.out)) << done.ran.out;
    EXPECT_LT(done.ran.out.size(), 10000U);
  }
}

constexpr const char* bad = "malformed_output";

std::string name_of(const testing::TestParamInfo<Cheat>& test) {
  std::string name = test.param.mode;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Said, CheatTest,
    testing::Values(
        Cheat{"seq-as-text", bad, "sequence number"}, Cheat{"seq-with-a-point", bad, "sequence number"},
        Cheat{"seq-with-an-exponent", bad, "sequence number"}, Cheat{"seq-and-2-to-the-32", bad, "sequence number"},
        Cheat{"seq-twice", bad, "\"seq\" is there twice"}, Cheat{"result-twice", bad, "\"result\" is there twice"},
        Cheat{"visible-twice", bad, "\"visible\" is there twice"},
        Cheat{"visible-twice-escaped", bad, "\"visible\" is there twice"}, Cheat{"result-in-the-statistics", "unsound"},
        Cheat{"a-list-of-the-hidden", bad, "unknown field 'hidden'"},
        Cheat{"capabilities-in-the-reply", bad, "unknown field 'capabilities'"},
        Cheat{"the-outcome-in-the-reply", bad, "unknown field 'outcome'"},
        Cheat{"everything-by-word", bad, "not a list"}, Cheat{"everything-by-truth", bad, "not a list"},
        Cheat{"everything-by-object", bad, "not a list"}, Cheat{"ids-as-text", bad, "not a triangle id"},
        Cheat{"ids-with-a-point", bad, "not a triangle id"}, Cheat{"ids-with-an-exponent", bad, "not a triangle id"},
        Cheat{"ids-in-lists", bad, "holds a list"}, Cheat{"ids-of-2-to-the-32", bad, "'visible' holds 4294967296"},
        Cheat{"ids-of-2-to-the-64", bad, "not a triangle id"}, Cheat{"ids-that-are-no-number", bad, "not JSON"},
        Cheat{"ids-that-are-infinite", bad, "too large"}, Cheat{"ids-that-are-null", bad, "not a triangle id"},
        Cheat{"minus-zero", bad, "'visible' holds"}, Cheat{"the-same-ids-a-thousand-times", "unsound"},
        Cheat{"deep-lists", bad, "nested more than 32 deep"},
        Cheat{"deep-statistics", bad, "nested more than 32 deep"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Lines, CheatTest,
    testing::Values(
        Cheat{"two-replies-in-a-line", bad, "not JSON"}, Cheat{"another-reply-first", bad, "no field 'seq'"},
        Cheat{"an-empty-line-first", bad, "is not JSON"}, Cheat{"a-reply-and-half-a-line", bad, "more than one line"},
        Cheat{"a-byte-order-mark", "unsound"}, Cheat{"nul-at-the-end", bad, "NUL"},
        Cheat{"another-reply-after-a-nul", bad, "NUL"}, Cheat{"utf-16", bad, "NUL"},
        Cheat{"a-line-without-its-end", "timeout", "no answer in time", Cheat::anywhere, true},
        Cheat{"a-line-without-its-end-and-exit", "crash", "exit status 0"},
        Cheat{"closes-its-output", "timeout", "closed its output", Cheat::anywhere, true},
        Cheat{"closes-all-but-the-output", "crash", "closed its input", Cheat::at_first},
        Cheat{"answers-late", "timeout", "no answer in time", Cheat::anywhere, true},
        Cheat{"answers-bit-by-bit", "timeout", "no answer in time", Cheat::at_first, true},
        Cheat{"stops-itself", "timeout", "no answer in time", Cheat::at_first, true},
        Cheat{"floods-standard-error-for-ever", "timeout", "no answer in time", Cheat::anywhere, true},
        Cheat{"floods-standard-error-after-its-answer", "timeout", "did not end after 'stop'", Cheat::at_last, true},
        Cheat{"never-ends", "timeout", "did not end after 'stop'", Cheat::at_last, true},
        Cheat{"crashes-after-its-answer", "crash", "signal 11"},
        Cheat{"crashes-after-a-good-answer", "crash", "signal 11"},
        Cheat{"exits-after-its-answer", "crash", "exit status 0", Cheat::at_first},
        Cheat{"kills-itself-after-its-answer", "crash", "signal 9", Cheat::at_last},
        Cheat{"ends-with-7", "crash", "exit status 7", Cheat::at_last}),
    name_of);

INSTANTIATE_TEST_SUITE_P(Processes, CheatTest,
                         testing::Values(Cheat{"answers-from-a-grandchild", "crash", "exit status 0"},
                                         Cheat{"leaves-a-process-behind", "unsound"},
                                         Cheat{"leaves-processes-behind-and-crashes", "crash", "signal 11"},
                                         Cheat{"leaves-a-process-behind-and-hangs", "timeout", "", Cheat::at_first,
                                               true},
                                         Cheat{"leaves-a-flood-behind", "crash", "signal 11"},
                                         Cheat{"leaves-forking-processes-behind", "crash", "signal 11"},
                                         Cheat{"kills-its-parent", "crash", "killed the process that watches it"},
                                         Cheat{"stops-its-parent", "timeout", "", Cheat::at_first, true},
                                         Cheat{"signals-its-parent", "unsound"}, Cheat{"writes-the-report", "unsound"}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Shown, CheatTest,
                         testing::Values(Cheat{"nul-in-a-message", "errored", "a\\x00b"},
                                         Cheat{"escape-sequences-in-a-message", "errored",
                                               "\\x1b[2J\\x1b]0;x\\x07\\u{009b}2J\\u{202e}"},
                                         Cheat{"a-summary-in-a-message", "errored", "x\\n\\n12 cases: 12 executed"},
                                         Cheat{"escape-sequences-in-an-address", "errored", "(\\x1b[31m)"},
                                         Cheat{"a-megabyte-of-message", "errored", "xxx..."},
                                         Cheat{"escape-sequences-on-standard-error", "crash",
                                               "\\x1b[2J\\x1b]0;x\\x07 12 tight\\x0d\\u{009b}2J"},
                                         Cheat{"escape-sequences-instead-of-json", bad, "'\\x1b[2J"},
                                         Cheat{"escape-sequences-in-a-key", bad, "unknown field '\\x1b[2J'"},
                                         Cheat{"no-utf-8-in-a-message", bad, "is not JSON"}),
                         name_of);

// ---- at the start

TEST(CheatsAtTheStart, AreRefused) {
  for (const std::string mode : {"no-modes", "protocol-with-a-point", "modes-twice"}) {
    const auto done = try_cheat(mode, "", "10");
    EXPECT_EQ(done.ran.exit_code, 2) << mode;
    EXPECT_THAT(done.ran.err, HasSubstr("no proper reply to 'start'"));
  }
}

TEST(CheatsAtTheStart, ASecondReplyIsNoAnswer) {
  const auto done = try_cheat("start-twice", "", "10");
  EXPECT_EQ(done.ran.exit_code, 1);
  EXPECT_THAT(done.outcomes, testing::Each(testing::Pair(testing::_, bad)));
}

TEST(CheatsAtTheStart, ANameIsShownAsItIs) {
  const auto done = try_cheat("name-that-rules-the-terminal", "", "10");
  EXPECT_TRUE(is_fit_for_a_terminal(done.ran.out));
  EXPECT_THAT(done.ran.out,
              testing::StartsWith("implementation: \\x1b[2Jname\\n12 cases: 12 executed, 12 tight\\n 1\\x002 ("));
}

// What the runner knows, it has read before the first question.
TEST(CheatsWithFiles, ASuiteThatIsChangedMeanwhileChangesNothing) {
  const TestFolder folder;
  fs::copy(small_suite, folder.file("suite"));
  const auto script = folder.write("cheat.sh", "for f in suite/*.json; do echo '{}' > $f; done; exec \"$@\"\n");
  const auto ran = run_clues({"conform", "--suite", "suite", "--impl", "sh '" + script + "' " + planted("hides-one")},
                             folder.path());
  EXPECT_EQ(read_all(folder.file("suite/basics.json")), "{}\n");
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_THAT(ran.out, HasSubstr("12 cases: 12 executed, 12 unsound"));
}

// ---- answers in files

struct BadAnswer {
  const char* name;
  std::function<void(const TestFolder& folder, const std::string& id)> make;
  const char* outcome;
  const char* says;
};

void PrintTo(const BadAnswer& answer, std::ostream* out) { *out << answer.name; }

class BadAnswerTest : public testing::TestWithParam<BadAnswer> {};

TEST_P(BadAnswerTest, IsNoAnswer) {
  const TestFolder folder;
  const std::string id = "wall-in-the-open";
  GetParam().make(folder, id);
  const auto done = conform({"--results", folder.path().string(), "--case", id});
  EXPECT_EQ(done.outcomes, (std::map<std::string, std::string>{{id, GetParam().outcome}})) << done.ran.out;
  EXPECT_THAT(done.ran.out, HasSubstr(GetParam().says));
  EXPECT_TRUE(is_fit_for_a_terminal(done.ran.out));
}

std::string result_with(const std::string& visible) {
  return R"({"format":"clues-result/1","visible":)" + visible + "}";
}

auto holding(std::string bytes, std::string ending = ".clues.json") {
  return [bytes = std::move(bytes), ending = std::move(ending)](const TestFolder& folder, const std::string& id) {
    folder.write(id + ending, bytes);
  };
}

auto linked_to(std::string target) {
  return [target = std::move(target)](const TestFolder& folder, const std::string& id) {
    fs::create_symlink(target, folder.file(id + ".pvs"));
  };
}

INSTANTIATE_TEST_SUITE_P(
    Attacks, BadAnswerTest,
    testing::Values(
        BadAnswer{"DeepLists", holding(result_with(std::string(60000, '[') + std::string(60000, ']'))), bad, "nested"},
        BadAnswer{"DeepStatistics",
                  holding(result_with("[0,1],\"stats\":" + std::string(60000, '[') + std::string(60000, ']'))), bad,
                  "nested"},
        BadAnswer{"VisibleTwice", holding(result_with("[],\"visible\":[0,1]")), bad, "twice"},
        BadAnswer{"NulAtTheEnd", holding(result_with("[0,1]") + std::string(3, '\0')), bad, "NUL"},
        BadAnswer{"IdsWithAPoint", holding(result_with("[0.0,1.0]")), bad, "not a triangle id"},
        BadAnswer{"EscapeSequences", holding(result_with("[\"\\u001b[2J\"]")), bad, "'\\x1b[2J' is not"},
        BadAnswer{"EscapeSequencesInAList", holding("0 \x1b[2J\n", ".pvs"), bad, "is not what a PVS holds"},
        BadAnswer{"LinkToZero", linked_to("/dev/zero"), bad, "pipe or a device"},
        BadAnswer{"LinkToTheInput", linked_to("/dev/stdin"), bad, ""},
        BadAnswer{"LinkToNothing", linked_to("nowhere"), "errored", "no result file"},
        BadAnswer{"Fifo",
                  [](const TestFolder& folder, const std::string& id) {
                    EXPECT_EQ(std::system(("mkfifo '" + folder.file(id + ".pvs") + "'").c_str()), 0);
                  },
                  bad, "pipe or a device"},
        BadAnswer{
            "Folder",
            [](const TestFolder& folder, const std::string& id) { fs::create_directory(folder.file(id + ".pvs")); },
            bad, "is a folder"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace clues::tests
