// The reader of vectors/: what it accepts comes back bit for bit, and what it rejects is named.
#include "validate/vectors/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "scene/messages/error.h"
#include "tests/validate/vectors_support.h"
#include "validate/vectors/writer.h"

namespace clues::validate {
namespace {

using nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;
using tests::SuiteFolder;

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const scene::Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(VectorReader, CanonicalTextComesBackByteForByte) {
  const SuiteFolder suite;
  const std::string text = suite.text("screens.json");
  EXPECT_EQ(to_json_text(parse_vector_file(text, "screens.json")), text);
  const auto index = read_vector_index(suite.path());
  EXPECT_EQ(to_json_text(index), suite.text("index.json"));
}

TEST(VectorReader, CasesHoldWhatTheFileSays) {
  const SuiteFolder suite;
  const auto cases = read_suite(suite.path());
  ASSERT_EQ(cases.size(), 1U);
  const auto& c = cases[0];
  EXPECT_EQ(c.topic, "screens");
  EXPECT_EQ(c.mesh.triangles.size(), 7U);
  EXPECT_EQ(c.mesh.face_of.back(), 6U);
  EXPECT_EQ(c.mesh.points[7], (scene::Point{-.5, -.5, 2.25}));
  EXPECT_EQ(c.cell.size(), 8U);
  ASSERT_TRUE(c.expect.has_value());
  EXPECT_EQ(c.expect->must_be_visible[3].p[0], "37/4");
  EXPECT_TRUE(c.expect->must_be_visible[4].meets_cell);
  EXPECT_EQ(c.expect->first_order_visible, (std::vector<std::uint32_t>{0, 1, 2, 4, 5}));
}

TEST(VectorReader, HexFloatsKeepEveryBit) {
  for (const double x : {0.0, -0.0, 1.5, -1e7, 0.1, 5e-324, -2.5e-310, std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::min(), std::nextafter(1.0, 2.0)}) {
    const SuiteFolder suite;
    suite.spoil([&](auto& file) { file["scenes"]["screen"]["vertices"][0][0] = to_hex_float(x); });
    const double back = read_suite(suite.path())[0].mesh.points[0][0];
    EXPECT_EQ(std::memcmp(&back, &x, sizeof x), 0) << to_hex_float(x);
  }
  EXPECT_EQ(to_hex_float(-3.0), "-0x1.8p+1");
}

TEST(VectorReader, ErrorsNameFileCaseAndField) {
  struct Spoiled {
    std::function<void(ordered_json&)> change;
    std::string says;  // beside the file
  };
  const auto in_case = [](const char* field, const ordered_json& value) {
    return [=](ordered_json& file) { file["cases"][0][field] = value; };
  };
  const std::vector<Spoiled> all{
      {[](auto& f) { f["colour"] = "red"; }, "unknown field \"colour\""},
      {[](auto& f) { f.erase("topic"); }, "the field \"topic\" is missing"},
      {[](auto& f) { f["format"] = "clues-vectors/2"; }, "format"},
      {[](auto& f) { f["topic"] = "other"; }, "named after its topic"},
      {[](auto& f) { f["definition"] = "see D5"; }, "definition"},
      {[](auto& f) { f["source"]["seed"] = -1; }, "source.seed"},
      {[](auto& f) { f["source"]["version"] = "today"; }, "source.version"},
      {[](auto& f) { f["notes"]["Screen"]["bug_type"] = "BUG"; }, "notes.Screen.bug_type"},
      {[](auto& f) { f["notes"]["Other"] = f["notes"]["Screen"]; }, "no case has this flag"},
      {[](auto& f) { f["notes"]["Screen"]["hazards"][0] = "C-1"; }, "notes.Screen.hazards[0]"},
      {[](auto& f) { f["scenes"]["unused"] = f["scenes"]["screen"]; }, "no case uses this scene"},
      {[](auto& f) { f["scenes"]["screen"]["vertices"][2][1] = "1.5"; }, "scenes.screen.vertices[2][1]"},
      {[](auto& f) { f["scenes"]["screen"]["vertices"][2][1] = 1.5; }, "scenes.screen.vertices[2][1]"},
      {[](auto& f) { f["scenes"]["screen"]["vertices"][2][1] = "0x1p+5000"; }, "not a finite double"},
      {[](auto& f) { f["scenes"]["screen"]["vertices"][2].push_back("0x0p+0"); }, "at most 3"},
      {[](auto& f) { f["scenes"]["screen"]["triangles"][1][2] = 16; }, "16 is out of range"},
      {[](auto& f) { f["scenes"]["screen"]["triangles"][1][2] = -1; }, "scenes.screen.triangles[1][2]"},
      {[](auto& f) { f["scenes"]["screen"]["see_through"] = ordered_json::array(); }, "see_through: is empty"},
      {[](auto& f) { f["scenes"]["screen"]["see_through"] = {16}; }, "16 is out of range"},
      {[](auto& f) {
         f["scenes"]["screen"]["not_counted"] = {1, 0};
       },
       "must ascend"},
      {[](auto& f) { f["scenes"]["screen"]["see_through"] = f["scenes"]["screen"]["not_counted"] = {1}; },
       "triangle 1 neither blocks nor counts"},
      {[](auto& f) { f["scenes"]["screen"]["not_counted"] = {1}; }, "triangle 1 does not count"},
      {[](auto& f) {
         f["scenes"]["screen"]["see_through"] = {1};
         f["cases"][0]["mode"] = "solid";
       },
       "in solid mode every triangle blocks"},
      {[](auto& f) { f["cases"] = ordered_json::array(); }, "at least 1"},
      {[](auto& f) { f["cases"].push_back(f["cases"][0]); }, "is there twice"},
      {in_case("id", "Screen_1"), "cases[0].id"},
      {in_case("colour", "red"), "unknown field \"colour\""},
      {in_case("flags", {"Nothing"}), "cases[0].flags[0]: \"Nothing\" is not explained"},
      {in_case("flags", ordered_json::array()), "cases[0].flags"},
      {in_case("flags", {"Screen", "Screen"}), "is there twice"},
      {in_case("level", "hard"), "cases[0].level"},
      {in_case("mode", "both"), "cases[0].mode"},
      {in_case("scene", "none"), "there is no scene \"none\""},
      {in_case("cell", ordered_json::array()), "cases[0].cell"},
      {in_case("comment", ""), "cases[0].comment"},
  };
  for (const auto& spoiled : all) {
    const SuiteFolder suite;
    suite.spoil(spoiled.change);
    EXPECT_THAT(message_of([&] { read_suite(suite.path()); }),
                AllOf(HasSubstr("screens.json"), HasSubstr(spoiled.says)));
  }
}

TEST(VectorReader, ErrorsInExpectationsNameTheTriangle) {
  struct Spoiled {
    std::function<void(ordered_json&)> change;  // of "expect"
    std::string says;
  };
  const std::vector<Spoiled> all{
      {[](auto& e) { e["umbra"].clear(); }, "triangle 3 must be in exactly one"},
      {[](auto& e) {
         e["no_surface"].push_back(5);
         std::swap(e["no_surface"][0], e["no_surface"][1]);
       },
       "triangle 5 must be in exactly one"},
      {[](auto& e) { e["umbra"][0]["triangle"] = 7; }, "expect.umbra[0].triangle: 7 is out of range"},
      {[](auto& e) { e["umbra"][0]["proof"] = "sampling"; }, "expect.umbra[0].proof"},
      {[](auto& e) { e["must_be_visible"][4]["meets_cell"] = false; }, "expect.must_be_visible[4].meets_cell"},
      {[](auto& e) { e["must_be_visible"][4]["front"] = true; }, "unknown field \"front\""},
      {[](auto& e) { e["must_be_visible"][0].erase("p"); }, "the field \"p\" is missing"},
      {[](auto& e) { e["must_be_visible"][0]["p"][0] = "1.5"; }, "expect.must_be_visible[0].p[0]"},
      {[](auto& e) { e["must_be_visible"][0]["p"][0] = "1/0"; }, "expect.must_be_visible[0].p[0]"},
      {[](auto& e) { e["must_be_visible"][0]["p"][0] = "-0"; }, "expect.must_be_visible[0].p[0]"},
      {[](auto& e) { std::swap(e["must_be_visible"][0], e["must_be_visible"][1]); }, "must ascend"},
      {[](auto& e) {
         e["first_order_visible"] = {1, 0};
       },
       "must ascend"},
      {[](auto& e) { e["tight"] = true; }, "unknown field \"tight\""},
  };
  for (const auto& spoiled : all) {
    const SuiteFolder suite;
    suite.spoil([&](auto& file) { spoiled.change(file["cases"][0]["expect"]); });
    EXPECT_THAT(
        message_of([&] { read_suite(suite.path()); }),
        AllOf(HasSubstr("screens.json"), HasSubstr("case screen-hides-what-is-right-behind"), HasSubstr(spoiled.says)));
  }
}

TEST(VectorReader, FieldsThatAreThereTwiceAreFound) {
  const SuiteFolder suite;
  std::string text = suite.text("screens.json");
  text.insert(text.find("\"topic\""), "\"topic\": \"screens\", ");
  EXPECT_THAT(message_of([&] { parse_vector_file(text, "screens.json"); }), HasSubstr("\"topic\" is there twice"));
  EXPECT_THAT(message_of([&] { parse_vector_file("{", "screens.json"); }),
              HasSubstr("screens.json:1: this is not JSON"));
}

TEST(VectorReader, TheSuiteMustAgreeWithItsIndex) {
  const auto with = [](const std::function<void(ordered_json&)>& change) {
    const SuiteFolder suite;
    auto index = ordered_json::parse(suite.text("index.json"));
    change(index);
    suite.put("index.json", index.dump());
    return message_of([&] { read_suite(suite.path()); });
  };
  const char* const id = "screen-hides-what-is-right-behind";
  EXPECT_EQ(with([](auto&) {}), "no error");
  EXPECT_THAT(with([&](auto& i) { i["cases"].erase(id); }), HasSubstr("is not an active case"));
  EXPECT_THAT(with([&](auto& i) { i["cases"][id]["status"] = "withdrawn"; }), HasSubstr("reason"));
  EXPECT_THAT(with([&](auto& i) {
                i["cases"][id] = {{"topic", "screens"}, {"status", "withdrawn"}, {"reason", "wrong"}};
              }),
              HasSubstr("is not an active case"));
  EXPECT_THAT(with([&](auto& i) { i["cases"]["gone"] = i["cases"][id]; }),
              HasSubstr("case gone: is active, but no file has it"));
  EXPECT_THAT(with([&](auto& i) { i["cases"][id]["author"] = "me"; }), HasSubstr("unknown field \"author\""));
  EXPECT_THAT(message_of([] { read_suite("/nonexistent"); }), HasSubstr("no such folder"));
}

TEST(VectorReader, Globs) {
  EXPECT_TRUE(matches_glob("edge-grazes", "*"));
  EXPECT_TRUE(matches_glob("edge-grazes", "edge-*"));
  EXPECT_TRUE(matches_glob("edge-grazes", "*gr?z*s"));
  EXPECT_FALSE(matches_glob("edge-grazes", "edge"));
  EXPECT_FALSE(matches_glob("edge-grazes", "*x"));
  EXPECT_FALSE(matches_glob("", "?"));
  EXPECT_TRUE(matches_glob("", "**"));
  EXPECT_TRUE(matches_glob("a-b-ab", "*ab"));
  EXPECT_FALSE(matches_glob("edge*", "edge?x"));
  // Linear in the stars: a search through all of their lengths would not end.
  std::string stars;
  for (int i = 0; i < 40; ++i) stars += "*a";
  EXPECT_FALSE(matches_glob(std::string(200, 'a'), stars + "b"));
}

}  // namespace
}  // namespace clues::validate
