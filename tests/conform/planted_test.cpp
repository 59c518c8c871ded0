// The tests of the suite: implementations that are wrong in one known way, against the small suite of this folder and the published one. A suite, or a
// runner, that lets one of them pass is broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support.h"

namespace clues::tests {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Pair;

constexpr const char* screen = "screen-hides-one-triangle";

std::size_t count(const Conformed& done, const std::string& outcome) {
  return done.report["total"]["outcomes"][outcome].get<std::size_t>();
}

// The planted programs know no flags (D22): cases of that kind are not put to them, and no others are left out.
std::size_t asked(const Conformed& done) {
  std::size_t left_out = 0;
  for (const auto& test : done.report["cases"]) {
    const bool unsupported = test["outcome"] == "unsupported";
    EXPECT_EQ(unsupported, test["topic"] == "see-through") << test["id"];
    left_out += unsupported ? 1 : 0;
  }
  return done.outcomes.size() - left_out;
}

// ---- wrong answers, against both suites

struct WrongMethod {
  const char* mode;
  const char* unsound;  // a case of the small suite that must see it
};

void PrintTo(const WrongMethod& method, std::ostream* out) { *out << method.mode; }

class WrongMethodTest : public testing::TestWithParam<WrongMethod> {
 protected:
  static void expect_caught(const Conformed& done) {
    EXPECT_EQ(done.ran.exit_code, 1) << done.ran.err;
    EXPECT_GT(count(done, "unsound"), 0U);
    EXPECT_THAT(done.ran.out, AllOf(HasSubstr("UNSOUND "), HasSubstr("\n  repeat: clues conform --suite ")));
    for (const char* other : {"malformed_output", "crash", "timeout", "resource", "skipped"}) {
      EXPECT_EQ(count(done, other), 0U) << other;
    }
    EXPECT_GT(asked(done), 0);
    for (const auto& test : done.report["cases"]) {
      if (test["outcome"] != "unsound") continue;
      EXPECT_FALSE(test["missed"].empty()) << test["id"];
      for (const auto& missed : test["missed"]) EXPECT_TRUE(missed.contains("meets_cell") || missed.contains("v"));
    }
  }
};

TEST_P(WrongMethodTest, IsUnsoundInTheSmallSuite) {
  const auto done = conform({"--impl", planted(GetParam().mode)});
  expect_caught(done);
  EXPECT_EQ(done.outcomes.at(GetParam().unsound), "unsound");
}

TEST_P(WrongMethodTest, IsUnsoundInThePublishedSuite) {
  const auto done = conform({"--impl", planted(GetParam().mode), "--time-limit", "300"}, published_suite);
  expect_caught(done);
  std::cout << GetParam().mode << ": " << count(done, "unsound") << " unsound of " << asked(done) << "\n";
}

constexpr const char* rim = "seen-from-the-rim-of-the-cell-only";
INSTANTIATE_TEST_SUITE_P(Methods, WrongMethodTest,
                         testing::Values(WrongMethod{"everything-hidden", "wall-in-the-open"},
                                         WrongMethod{"hides-one", "wall-in-the-open"},
                                         WrongMethod{"from-centre", "slit-off-centre"},
                                         WrongMethod{"random-rays", "two-crossed-slits"},
                                         WrongMethod{"float32", "gap-of-one-ulp"}, WrongMethod{"cell-shrunk", rim},
                                         WrongMethod{"drops-small", "small-triangle-in-the-open"}),
                         [](const auto& test) {
                           std::string name;
                           for (const char* c = test.param.mode; *c != 0; ++c)
                             name += *c == '-' ? "_" : std::string(1, *c);
                           return name;
                         });

void expect_sound_and_loose(const Conformed& done) {
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out << done.ran.err;
  EXPECT_EQ(count(done, "tight") + count(done, "conservative"), asked(done));
  EXPECT_GT(count(done, "conservative"), 0U);
  EXPECT_GT(done.report["total"]["overestimate_qo"].get<double>(), 0.1);
  EXPECT_EQ(done.report["total"]["underestimate_qu"], 0.0);
  EXPECT_GT(done.report["total"]["looser_than_first_order"].get<int>(), 0);
}

TEST(EverythingVisible, IsSoundAndALargeOverestimate) {
  expect_sound_and_loose(conform({"--impl", planted("everything-visible")}));
  expect_sound_and_loose(conform({"--impl", planted("everything-visible")}, published_suite));
}

void expect_within_first_order(const Conformed& done) {
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out << done.ran.err;
  EXPECT_EQ(count(done, "tight") + count(done, "conservative"), done.outcomes.size());
  EXPECT_EQ(done.report["total"]["looser_than_first_order"], 0);
}

TEST(Reference, IsSoundThroughItsOwnDoor) {
  const std::string clues = "'" CLUES_PROGRAM "' iut --kernel exact";
  const auto done = conform({"--impl", clues});
  expect_within_first_order(done);
  EXPECT_EQ(count(done, "tight"), done.outcomes.size());
  expect_within_first_order(conform({"--impl", clues, "--time-limit", "300"}, published_suite));
}

// Within the usual limit of time: no scene of the suite is to be slow. Sanitizers take five to ten times as long.
TEST(FastPath, IsSoundThroughItsOwnDoor) {
#ifdef __SANITIZE_ADDRESS__
  const char* const limit = "100";
#else
  const char* const limit = "10";
#endif
  expect_within_first_order(
      conform({"--impl", "'" CLUES_PROGRAM "' iut --kernel fast", "--time-limit", limit}, published_suite));
}

// Of edges it knows nothing, so its lists are longer.
TEST(Solids, AreSoundThroughTheirOwnDoor) {
  const auto done = conform({"--impl", "'" CLUES_PROGRAM "' iut --kernel solids"}, published_suite);
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out << done.ran.err;
  EXPECT_EQ(count(done, "tight") + count(done, "conservative"), done.outcomes.size());
  EXPECT_GT(count(done, "tight"), done.outcomes.size() / 2);
}

TEST(EverythingHidden, HasAnUnderestimateOfOne) {
  const auto done = conform({"--impl", planted("everything-hidden")});
  EXPECT_EQ(done.report["total"]["underestimate_qu"], 1.0);
  EXPECT_EQ(done.report["total"]["overestimate_qo"], 0.0);
  EXPECT_EQ(count(done, "unsound"), done.outcomes.size());
}

// ---- misbehaviour in one case; every other case must come out as if nothing had happened

struct Misbehaviour {
  const char* mode;
  const char* outcome;
  const char* says;
  int exit_code;
};

void PrintTo(const Misbehaviour& planted, std::ostream* out) { *out << planted.mode; }

class MisbehaviourTest : public testing::TestWithParam<Misbehaviour> {};

TEST_P(MisbehaviourTest, IsSaidOfTheRightCaseOnly) {
  const auto usual = conform({"--impl", planted("everything-visible")});
  for (const std::string id : {screen, "gap-of-zero"}) {
    const auto done = conform({"--impl", planted(GetParam().mode, id)});
    EXPECT_EQ(done.ran.exit_code, GetParam().exit_code) << done.ran.out << done.ran.err;
    EXPECT_EQ(done.ran.err, "");
    EXPECT_THAT(done.ran.out, HasSubstr(GetParam().says));
    auto expected = usual.outcomes;
    expected[id] = GetParam().outcome;
    EXPECT_EQ(done.outcomes, expected);
  }
}

TEST_P(MisbehaviourTest, IsSaidOfEveryCase) {
  const auto done = conform({"--impl", planted(GetParam().mode)});
  EXPECT_EQ(done.ran.exit_code, GetParam().exit_code == 0 ? 3 : GetParam().exit_code);
  EXPECT_THAT(done.outcomes, Each(Pair(testing::_, GetParam().outcome)));
  EXPECT_EQ(done.outcomes.size(), 12U);
}

INSTANTIATE_TEST_SUITE_P(
    Planted, MisbehaviourTest,
    testing::Values(Misbehaviour{"crashes", "crash", "signal 11", 1},
                    Misbehaviour{"exits", "crash", "exit status 3", 1},
                    Misbehaviour{"ends-silently", "crash", "exit status 0", 1},
                    Misbehaviour{"crashes-in-its-line", "crash", "signal 11", 1},
                    Misbehaviour{"answers-twice", "malformed_output", "more than one line", 1},
                    Misbehaviour{"lies-about-seq", "malformed_output", "sequence number", 1},
                    Misbehaviour{"out-of-range", "malformed_output", "the scene has the triangles 0 to", 1},
                    Misbehaviour{"negative-id", "malformed_output", "'visible' holds -1", 1},
                    Misbehaviour{"fractional-id", "malformed_output", "not a triangle id", 1},
                    Misbehaviour{"not-json", "malformed_output", "is not JSON", 1},
                    Misbehaviour{"unknown-field", "malformed_output", "unknown field 'vissible'", 1},
                    Misbehaviour{"two-kinds", "malformed_output", "exactly one of", 1},
                    Misbehaviour{"endless-line", "malformed_output", "wrote without end", 1},
                    Misbehaviour{"floods-after-its-answer", "malformed_output", "more than one line", 1},
                    Misbehaviour{"nests-deeply", "malformed_output", "nested more than 32 deep", 1},
                    Misbehaviour{"errs", "errored", "planted", 3}, Misbehaviour{"skips", "skipped", "1 skipped", 0},
                    Misbehaviour{"rejects", "rejected_input", "1 rejected_input", 0}),
    [](const auto& test) {
      std::string name;
      for (const char* c = test.param.mode; *c != 0; ++c) name += *c == '-' ? "_" : std::string(1, *c);
      return name;
    });

// ---- what costs time or memory

TEST(Hanging, IsKilledWithAllItsChildren) {
  for (const std::string mode : {"hangs", "hangs-with-child", "hangs-in-another-group"}) {
    const auto done = conform({"--impl", planted(mode), "--case", screen, "--time-limit", "0.2"});
    EXPECT_EQ(done.ran.exit_code, 1);
    EXPECT_EQ(done.outcomes, (std::map<std::string, std::string>{{screen, "timeout"}}));
    EXPECT_THAT(done.ran.out,
                AllOf(HasSubstr("TIMEOUT screen"), HasSubstr("--time-limit 0.2 --case screen-hides-one-triangle\n")));
  }
}

TEST(Hanging, StopsAtTheErrorLimit) {
  const auto done = conform({"--impl", planted("hangs"), "--time-limit", "0.2", "--errors", "2"});
  EXPECT_EQ(count(done, "timeout"), 2U);
  EXPECT_EQ(done.report["not_reached"], 10);
  EXPECT_EQ(done.ran.exit_code, 1);
}

TEST(StandardError, MayBeFlooded) {
  const auto done = conform({"--impl", planted("floods-stderr")});
  EXPECT_EQ(done.ran.exit_code, 0) << done.ran.out;
}

TEST(StandardError, IsShownAfterACrash) {
  EXPECT_THAT(conform({"--impl", planted("crashes"), "--case", screen}).ran.out, HasSubstr("about to crash"));
}

TEST(Memory, RunningOutIsNoCrash) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer needs all of the address space";
#else
  const auto done = conform({"--impl", planted("memory"), "--case", screen, "--memory-limit", "600"});
  EXPECT_EQ(done.outcomes, (std::map<std::string, std::string>{{screen, "resource"}})) << done.ran.out;
  EXPECT_EQ(done.ran.exit_code, 3);
#endif
}

// ---- capabilities

TEST(Capabilities, Float32GetsOnlyWhatIsExactInFloat32) {
  const auto done = conform({"--impl", planted("reads-float32")});
  EXPECT_EQ(done.ran.exit_code, 0);
  EXPECT_EQ(done.outcomes.at("gap-of-one-ulp"), "skipped");
  EXPECT_EQ(done.outcomes.at(rim), "skipped");
  EXPECT_EQ(done.outcomes.at(screen), "conservative");
  EXPECT_EQ(conform({"--impl", planted("reads-float32"), "--case", "gap-of-one-ulp"}).ran.exit_code, 3);
}

TEST(Capabilities, AModeThatIsNotKnownIsUnsupported) {
  const auto done = conform({"--impl", planted("sheet-only")});
  EXPECT_EQ(done.ran.exit_code, 0);
  EXPECT_EQ(done.outcomes.at("box-shows-its-front-to-a-small-cell"), "unsupported");
  EXPECT_EQ(count(done, "unsupported"), 1U);
}

}  // namespace
}  // namespace clues::tests
