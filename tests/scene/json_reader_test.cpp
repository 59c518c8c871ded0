// The one reader of JSON: a table of what it refuses, with the line and the word that the message must have.
#include "scene/json_reader.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "scene/messages/printable.h"
#include "support.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using scene::ErrorCode;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

struct BadJson {
  const char* name;
  std::string text;
  const char* place;
  const char* says;
};

void PrintTo(const BadJson& bad, std::ostream* out) { *out << bad.name; }

class BadJsonTest : public testing::TestWithParam<BadJson> {};

TEST_P(BadJsonTest, IsRefusedInOnePrintableLine) {
  const auto thrown = thrown_by([] { scene::parse_json(GetParam().text, "f.json"); });
  EXPECT_EQ(thrown.code, ErrorCode::malformed);
  EXPECT_THAT(thrown.text,
              AllOf(StartsWith(std::string("f.json") + GetParam().place + ": "), HasSubstr(GetParam().says)));
  EXPECT_LT(thrown.text.size(), 300U);
  EXPECT_EQ(scene::printable(thrown.text), thrown.text);
}

INSTANTIATE_TEST_SUITE_P(
    Attacks, BadJsonTest,
    testing::Values(
        BadJson{"Nothing", "", ":1", "ends too early"}, BadJson{"BlanksOnly", "\n\n ", ":3", "ends too early"},
        BadJson{"DeepLists", nested(60000), ":1", "nested more than 32 deep"},
        BadJson{"DeepListsThatAreCut", std::string(60000, '['), ":1", "nested more than 32 deep"},
        BadJson{"DeepObjects",
                [] {
                  std::string text;
                  for (int i = 0; i < 60000; ++i) text += "{\"a\":\n";
                  return text;
                }(),
                ":33", "nested more than 32 deep"},
        BadJson{"DeepInTheMiddle", "{\n\"visible\": [0,\n" + nested(33) + "]}", ":3", "nested"},
        BadJson{"TheSameKeyTwice", "{\"a\": 1,\n\"a\": 1}", ":2", "the field \"a\" is there twice"},
        BadJson{"TheSameKeyTwiceEscaped", "{\"a\": 1,\n\"\\u0061\": 1}", ":2", "the field \"a\" is there twice"},
        BadJson{"TheSameKeyTwiceInside", "[{\"a\": [{\"b\": 1,\n\n\"b\": 2}]}]", ":3", "\"b\" is there twice"},
        BadJson{"ALongKeyTwice", "{\"" + std::string(100000, 'k') + "\":1,\"" + std::string(100000, 'k') + "\":1}",
                ":1", "...\" is there twice"},
        BadJson{"AKeyThatRulesTheTerminalTwice", "{\"\\u001b[2J\": 1, \"\\u001b[2J\": 2}", ":1",
                "\"\\x1b[2J\" is there twice"},
        BadJson{"TrailingNul", std::string("{}\0", 3), ":1", "NUL"},
        BadJson{"NulInTheMiddle", std::string("{\"a\":\n1\0}", 9), ":2", "NUL"},
        BadJson{"TrailingWord", "{}\n{}", ":2", "not JSON"}, BadJson{"TrailingComma", "[1,]", ":1", "not JSON"},
        BadJson{"NotANumber", "[NaN]", ":1", "not JSON"}, BadJson{"Infinity", "[-Infinity]", ":1", "not JSON"},
        BadJson{"TooLargeForADouble", "[\n1e999]", ":2", "'1e999' is too large"},
        BadJson{"LeadingZero", "[01]", ":1", "not JSON"}, BadJson{"HexNumber", "[0x10]", ":1", "not JSON"},
        BadJson{"Comment", "[1] // one", ":1", "not JSON"}, BadJson{"SingleQuotes", "{'a': 1}", ":1", "not JSON"},
        BadJson{"ControlCharacterInAString", "[\"\x1b[2J\"]", ":1", "not JSON"},
        BadJson{"NoUtf8", "[\"\xff\"]", ":1", "not JSON"}, BadJson{"HalfASurrogate", "[\"\\ud800\"]", ":1", "not JSON"},
        BadJson{"CutInAString", "{\"a\": \"" + std::string(100000, 'x'), ":1", "not JSON"},
        BadJson{"Utf16", std::string("\xff\xfe{\0}\0", 6), ":1", "not JSON"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(JsonReader, ReadsWhatTheLibraryReads) {
  for (const std::string text :
       {"{}", "[]", "null", " true ", "\"a\\u0000b\"", "[1, -1, 0.5, 1e3, 18446744073709551615, -0.0]",
        R"({"b": {"a": [1, {"a": 2}, []]}, "a": [[], [3, [4]], {"b": {}}], "c": "\u00e4ß"})", "\xEF\xBB\xBF[1]"}) {
    EXPECT_EQ(scene::parse_json(text, "f"), json::parse(text)) << text;
  }
  EXPECT_EQ(scene::parse_json(nested(32), "f"), json::parse(nested(32)));
}

TEST(JsonReader, HasALimitOfSize) {
  EXPECT_NO_THROW(scene::parse_json("[1, 2]", "f", {6, 1}));
  EXPECT_THAT(thrown_by([] { scene::parse_json("[1, 22]", "f", {6, 1}); }).text, StartsWith("f: 7 bytes of JSON"));
}

TEST(JsonReader, WholeNumbersAreWhole) {
  EXPECT_EQ(scene::whole_number(json::parse("7"), "x", 7), 7U);
  EXPECT_EQ(scene::whole_number(json::parse("18446744073709551615"), "x"), 18446744073709551615U);
  for (const char* text :
       {"1.0", "1e2", "-1", "-0", "18446744073709551616", "8", "\"1\"", "true", "null", "[1]", "{}"}) {
    try {
      scene::whole_number(json::parse(text), "\"n\"", 7);
      ADD_FAILURE() << text;
    } catch (const scene::JsonError& error) {
      EXPECT_THAT(error.what(), StartsWith("\"n\" is ")) << text;
    }
  }
}

TEST(JsonReader, AnExcerptIsShortAndFlat) {
  EXPECT_EQ(scene::json_excerpt(json::parse(nested(60000))), "a list");
  EXPECT_EQ(scene::json_excerpt(json("a\x1b\n")), "'a\\x1b\\n'");
  EXPECT_LT(scene::json_excerpt(json(std::string(100000, 'x'))).size(), 80U);
}

}  // namespace
}  // namespace clues::tests
