// The messages themselves, and what an answer is worth, without any process.
#include "validate/conform/protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "scene/messages/error.h"
#include "validate/conform/grade.h"
#include "validate/conform/program_subject.h"

namespace clues::validate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::uint64_t> bits_of(const std::vector<scene::Point>& points) {
  std::vector<std::uint64_t> bits;
  for (const auto& point : points) {
    for (const double x : point) bits.push_back(std::bit_cast<std::uint64_t>(x));
  }
  return bits;
}

VectorCase some_case() {
  using limits = std::numeric_limits<double>;
  VectorCase test;
  test.id = "some-case";
  test.mode = CaseMode::solid;
  test.mesh.points = {{-0.0, limits::denorm_min(), limits::max()},
                      {0.1, 1 + limits::epsilon(), -limits::min()},
                      {1e22, 1e23, std::ldexp(1, -60) / 3}};
  test.mesh.triangles = {{0, 1, 2}, {2, 2, 0}};
  test.mesh.face_of = {0, 1};
  test.cell = {{9007199254740993.0, -0.0, 5e-324}};
  return test;
}

TEST(Protocol, CoordinatesSurviveBitForBit) {
  const auto test = some_case();
  const auto request = parse_request(run_request(4294967295U, test));
  EXPECT_EQ(request.kind, Request::Kind::run);
  EXPECT_EQ(request.seq, 4294967295U);
  EXPECT_EQ(request.mode, CaseMode::solid);
  EXPECT_EQ(bits_of(request.mesh.points), bits_of(test.mesh.points));
  EXPECT_EQ(bits_of(request.cell), bits_of(test.cell));
  EXPECT_EQ(request.mesh.triangles, test.mesh.triangles);
}

TEST(Protocol, FlagsSurvive) {
  auto test = some_case();
  EXPECT_TRUE(parse_request(run_request(1, test)).is_plain());
  EXPECT_EQ(run_request(1, test).find("see_through"), std::string::npos)
      << "who knows no flags reads what it always read";
  test.blocks = {1, 0};
  test.counts = {0, 1};
  const auto request = parse_request(run_request(1, test));
  EXPECT_EQ(request.blocks, test.blocks);
  EXPECT_EQ(request.counts, test.counts);
  test.counts = {1, 0};
  EXPECT_THROW(parse_request(run_request(1, test)), ProtocolError) << "triangle 1 would do neither";
  EXPECT_FALSE(parse_start_reply(start_reply({})).see_through);
  Implementation about;
  about.see_through = true;
  EXPECT_TRUE(parse_start_reply(start_reply(about)).see_through);
}

TEST(Protocol, BothEndsAgree) {
  Implementation about;
  about.name = "n";
  about.version = "v";
  about.language = "l";
  about.homepage = "h";
  about.issues = "i";
  about.solid = false;
  about.float32 = true;
  const auto read = parse_start_reply(start_reply(about));
  EXPECT_EQ(read.name + read.version + read.language + read.homepage + read.issues, "nvlhi");
  EXPECT_TRUE(read.sheet && !read.solid && read.float32);
  for (const auto kind : {AnswerKind::visible, AnswerKind::skipped, AnswerKind::rejected_input, AnswerKind::errored,
                          AnswerKind::malformed_output}) {
    Answer answer;
    answer.kind = kind;
    if (kind == AnswerKind::visible) answer.visible = {0, 7};
    if (kind != AnswerKind::visible) answer.message = "why \xff";
    const auto again = parse_reply(run_reply(5, answer), 5, 8);
    EXPECT_EQ(again.kind, kind);
    EXPECT_EQ(again.visible, answer.visible);
    EXPECT_EQ(again.message.substr(0, 4), answer.message.substr(0, 4));
  }
  EXPECT_EQ(parse_request(start_request()).kind, Request::Kind::start);
  EXPECT_EQ(parse_request(stop_request()).kind, Request::Kind::stop);
}

TEST(Protocol, OrderAndRepetitionDoNotMatter) {
  EXPECT_THAT(parse_reply(R"({"seq":1,"result":{"visible":[3,0,3,1],"stats":{"rays":7}}})", 1, 4).visible,
              ElementsAre(0, 1, 3));
  EXPECT_THAT(parse_reply(R"({"seq":1,"result":{"visible":[]}})", 1, 4).visible, ElementsAre());
}

TEST(Protocol, WhatIsNoReplyIsMalformed) {
  for (const char* line : {"",
                           "null",
                           "[]",
                           "{}",
                           R"({"seq":1})",
                           R"({"result":{"visible":[]}})",
                           R"({"seq":"1","result":{"visible":[]}})",
                           R"({"seq":2,"result":{"visible":[]}})",
                           R"({"seq":1.5,"result":{"visible":[]}})",
                           R"({"seq":1,"result":[]})",
                           R"({"seq":1,"result":{}})",
                           R"({"seq":1,"result":{"visible":{}}})",
                           R"({"seq":1,"result":{"visible":[4]}})",
                           R"({"seq":1,"result":{"visible":[4294967296]}})",
                           R"({"seq":1,"result":{"visible":["0"]}})",
                           R"({"seq":1,"result":{"visible":[true]}})",
                           R"({"seq":1,"result":{"visible":[0.0]}})",
                           R"({"seq":1,"skipped":{}})",
                           R"({"seq":1,"skipped":"why"})",
                           R"({"seq":1,"errored":{"message":7}})",
                           R"({"seq":1,"rejected":{"message":"x","code":1}})",
                           R"({"seq":1,"result":{"visible":[]}} {})",
                           "{\"seq\":1,\"result\":{\"visible\":[1e999]}}",
                           "\xff\xfe"}) {
    const auto answer = parse_reply(line, 1, 4);
    EXPECT_EQ(answer.kind, AnswerKind::malformed_output) << line;
    EXPECT_FALSE(answer.message.empty());
  }
}

TEST(Protocol, WhatIsNoStartReplyIsAnError) {
  for (
      const char* line :
      {"", "{}", R"({"protocol":1})",
       R"({"protocol":1,"implementation":{"name":"n","version":"v"},"capabilities":{"modes":["sheet"]}})",
       R"({"protocol":1,"implementation":{"name":"n"},"capabilities":{"modes":["sheet"],"input":"float64"}})",
       R"({"protocol":1,"implementation":{"name":"n","version":"v"},"capabilities":{"modes":[],"input":"float64"}})",
       R"({"protocol":1,"implementation":{"name":"n","version":"v"},"capabilities":{"modes":["sheets"],"input":"float64"}})",
       R"({"protocol":1,"implementation":{"name":"n","version":"v"},"capabilities":{"modes":["sheet"],"input":"float16"}})",
       R"({"protocol":"1","implementation":{"name":"n","version":"v"},"capabilities":{"modes":["sheet"],"input":"float64"}})"}) {
    EXPECT_THROW(parse_start_reply(line), ProtocolError) << line;
  }
}

TEST(SplitCommand, FollowsTheShell) {
  EXPECT_THAT(split_command("python3 'my adapter.py' --x=\"a b\" c\\ d"),
              ElementsAre("python3", "my adapter.py", "--x=a b", "c d"));
}

TEST(SplitCommand, PlaceholdersNeedNoQuotes) {
  EXPECT_THAT(split_command("./bake {scene} {cell} -o {pvs}"),
              ElementsAre("./bake", "{scene}", "{cell}", "-o", "{pvs}"));
  EXPECT_THAT(split_command("bake --in={scene} '{cell}' \"{pvs}\" \\{mode\\}"),
              ElementsAre("bake", "--in={scene}", "{cell}", "{pvs}", "{mode}"));
  EXPECT_THAT(split_command("sh -c ': > {pvs}'"), ElementsAre("sh", "-c", ": > {pvs}"));
  setenv("CLUES_TEST_WORD", "a word", 1);
  EXPECT_THAT(split_command("x \"${CLUES_TEST_WORD}\" ${CLUES_TEST_WORD}{pvs}"),
              ElementsAre("x", "a word", "a", "word{pvs}"));
}

TEST(SplitCommand, SaysWhatIsNoCommandAndWhy) {
  for (const auto& [command, says] :
       std::vector<std::pair<std::string, std::string>>{{"bake {scene} | sort", "put pipes"},
                                                        {"bake {scene} > {pvs}", "put pipes"},
                                                        {"bake; rm x", "put pipes"},
                                                        {"bake & ", "put pipes"},
                                                        {"bake (x)", "put pipes"},
                                                        {"bake\nrm x", "put pipes"},
                                                        {"bake $(ls)", "command substitutions"},
                                                        {"bake `ls`", "command substitutions"},
                                                        {"bake $CLUES_NO_SUCH_VARIABLE", "not set"},
                                                        {"bake ${CLUES_NO_SUCH_VARIABLE}", "not set"},
                                                        {"bake 'x", "not closed"},
                                                        {"bake \"{scene}", "not closed"},
                                                        {"bake ${HOME", "not closed"},
                                                        {"bake \\", ""},
                                                        {"", "no word"},
                                                        {"  ", "no word"}}) {
    try {
      const auto words = split_command(command);
      EXPECT_EQ(says, "") << command;
    } catch (const scene::Error& error) {
      EXPECT_EQ(error.code(), scene::ErrorCode::bad_argument);
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("': not a command: "), testing::HasSubstr(says)));
    }
  }
}

TEST(Float32, IsExactOnlyWithoutRounding) {
  VectorCase test;
  test.mesh.points = {{0.5, -0.0, 16777216}};
  test.cell = {{std::ldexp(1, -149), 3.4028234663852886e38, 0}};
  EXPECT_TRUE(is_exact_in_float32(test));
  for (const double x : {0.1, 16777217.0, std::ldexp(1, -150), 1e39}) {
    auto bad = test;
    bad.cell[0][2] = x;
    EXPECT_FALSE(is_exact_in_float32(bad)) << x;
  }
}

// Triangles 0 and 1 are visible, 2 looks so to the first-order method, 3 is hidden, 4 has no area.
VectorCase graded_case() {
  VectorCase test;
  test.expect.emplace();
  for (const std::uint32_t t : {0U, 1U}) {
    test.expect->must_be_visible.emplace_back();
    test.expect->must_be_visible.back().triangle = t;
  }
  test.expect->umbra = {{2, UmbraProof::exhaustive}, {3, UmbraProof::first_order_map}};
  test.expect->no_surface = {4};
  test.expect->first_order_visible = {0, 1, 2};
  return test;
}

CaseResult graded(const VectorCase& test, const std::vector<std::uint32_t>& visible) {
  Answer answer;
  answer.visible = visible;
  return grade(test, answer);
}

TEST(Grade, ComparesWithWhatIsProved) {
  const auto test = graded_case();
  EXPECT_EQ(graded(test, {0, 1}).outcome, Outcome::tight);
  EXPECT_EQ(graded(test, {0, 1, 4}).outcome, Outcome::tight);
  const auto first_order = graded(test, {0, 1, 2});
  EXPECT_EQ(first_order.outcome, Outcome::conservative);
  EXPECT_THAT(first_order.extra, ElementsAre(2));
  EXPECT_THAT(first_order.out_of_first_order, ElementsAre());
  EXPECT_THAT(graded(test, {0, 1, 2, 3, 4}).out_of_first_order, ElementsAre(3));
  const auto unsound = graded(test, {1, 2, 3});
  EXPECT_EQ(unsound.outcome, Outcome::unsound);
  ASSERT_EQ(unsound.missed.size(), 1U);
  EXPECT_EQ(unsound.missed[0]->triangle, 0U);
}

TEST(Tally, QoAndQuAreRelativeToTheExactSet) {
  const auto test = graded_case();
  Tally tally;
  EXPECT_FALSE(tally.over_estimate().has_value());
  tally.add(graded(test, {0, 1, 2, 3}));  // two too many
  tally.add(graded(test, {0}));           // one missing
  Answer crash;
  crash.kind = AnswerKind::crash;
  tally.add(grade(test, crash));  // no PVS: in no sum
  EXPECT_EQ(tally.over_estimate(), 0.5);
  EXPECT_EQ(tally.under_estimate(), 0.25);
  EXPECT_EQ(tally.within_first_order, 1U);
  EXPECT_EQ(tally.looser, 1U);
  EXPECT_EQ(tally.cases, 3U);
  EXPECT_EQ(tally.of(Outcome::crash), 1U);
}

}  // namespace
}  // namespace clues::validate
