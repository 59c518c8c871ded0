// Result files and plain PVS lists (D7): the same bytes every time, and what is read is what was written.
#include "scene/result.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "scene/sealed_result.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using scene::ErrorCode;
using scene::read_pvs;
using scene::Result;
using testing::ElementsAre;
using testing::HasSubstr;

Result small_result() {
  Result result;
  result.scene_file = "scene.off";
  result.scene_sha256 = "00ff";
  result.scene_triangles = 10;
  result.cell = {{0.1, -0.0, 0x1p-1074}, {1, 2, 3}};
  result.visible = {1, 5, 9};
  result.stats = {{"wedges", 7}};
  return result;
}

Result result_with_map() {
  auto result = small_result();
  result.has_map = true;
  result.regions = {{.triangle = 5,
                     .front = false,
                     .visible = true,
                     .area_fraction = "1/3",
                     .area_estimate = 0,
                     .rings_exact = {{{"0", "1/3", "-2/7"}}},
                     .rings = {{{0, 1.0 / 3.0, -2.0 / 7.0}}},
                     .render_states = {}}};
  result.segments = {{.triangle = 5, .front = true, .boundary = true, .exact = {}, .points = {}}};
  result.wedges = {{.kind = "SV-ME",
                    .generation = 2,
                    .exact = {},
                    .points = {{{0, 0, std::numeric_limits<double>::infinity()}}},
                    .unbounded = true}};
  return result;
}

TEST(ResultText, ARegionHasAnExactFractionOrAnEstimate) {
  Result result = result_with_map();
  const auto exact = nlohmann::json::parse(scene::to_json_text(result))["regions"][0];
  EXPECT_EQ(exact["area_fraction"], "1/3");
  EXPECT_FALSE(exact.contains("area_estimate"));
  result.regions[0].area_fraction.clear();
  result.regions[0].area_estimate = 0.5;
  const auto estimate = nlohmann::json::parse(scene::to_json_text(result))["regions"][0];
  EXPECT_EQ(estimate["area_estimate"], 0.5);
  EXPECT_FALSE(estimate.contains("area_fraction") || estimate.contains("rings_exact"));
}

TEST(ResultText, IsExactlyThis) {
  Result result;
  result.scene_file = "a.off";
  result.scene_triangles = 2;
  result.cell = {{0.1, 0, 1}};
  result.visible = {1};
  EXPECT_EQ(scene::to_json_text(result), R"({
  "cell": {
    "vertices": [
      [
        0.1,
        0.0,
        1.0
      ]
    ]
  },
  "format": "clues-result/1",
  "kernel": "exact",
  "method": "first-order",
  "mode": "sheet",
  "scene": {
    "file": "a.off",
    "sha256": "",
    "triangles": 2
  },
  "stats": {
    "conservative_fallbacks": 0
  },
  "visible": [
    1
  ]
}
)");
}

TEST(ResultText, SameResultSameBytes) {
  EXPECT_EQ(scene::to_json_text(result_with_map()), scene::to_json_text(result_with_map()));
}

TEST(ResultText, CellKeepsEveryBit) {
  const auto parsed = json::parse(scene::to_json_text(small_result()));
  EXPECT_EQ(bits_of(parsed["cell"]["vertices"].get<std::vector<scene::Point>>()), bits_of(small_result().cell));
}

TEST(ResultText, StatsKeepWhatIsThere) {
  auto result = small_result();
  result.stats["conservative_fallbacks"] = 3;
  EXPECT_EQ(json::parse(scene::to_json_text(result))["stats"], json({{"conservative_fallbacks", 3}, {"wedges", 7}}));
}

TEST(ResultText, MapOnlyOnRequest) {
  const auto plain = json::parse(scene::to_json_text(small_result()));
  for (const char* key : {"regions", "segments", "wedges"}) EXPECT_FALSE(plain.contains(key));
  const auto parsed = json::parse(scene::to_json_text(result_with_map()));
  const auto& region = parsed["regions"][0];
  EXPECT_EQ(region["triangle"], 5);
  EXPECT_EQ(region["side"], "back");
  EXPECT_EQ(region["area_fraction"], "1/3");
  EXPECT_EQ(region["rings_exact"][0][0], json({"0", "1/3", "-2/7"}));
  EXPECT_EQ(region["rings"][0][0][1], 1.0 / 3.0);
  EXPECT_EQ(parsed["segments"][0]["side"], "front");
  EXPECT_EQ(parsed["segments"][0]["boundary"], true);
  EXPECT_EQ(parsed["wedges"][0]["kind"], "SV-ME");
  EXPECT_TRUE(parsed["wedges"][0]["points"][0][2].is_null());  // past the doubles; its exact text stands beside it
}

TEST(ResultText, FileNamesThatAreNotUtf8) {
  auto result = small_result();
  result.scene_file = "caf\xE9.off";
  EXPECT_TRUE(json::accept(scene::to_json_text(result)));
}

TEST(Pvs, RoundTripOfAResult) {
  const SceneFolder folder;
  const auto path = folder.write("a.clues.json", scene::to_json_text(result_with_map()));
  EXPECT_THAT(read_pvs(path, 10), ElementsAre(1, 5, 9));
}

TEST(Pvs, RoundTripOfAList) {
  const SceneFolder folder;
  EXPECT_EQ(scene::to_pvs_text({1, 5, 9}), "1\n5\n9\n");
  EXPECT_THAT(read_pvs(folder.write("a.pvs", scene::to_pvs_text({1, 5, 9})), 10), ElementsAre(1, 5, 9));
}

TEST(Pvs, ListsMayBeUntidy) {
  const SceneFolder folder;
  EXPECT_THAT(read_pvs(folder.write("a.txt", "# mine\r\n\r\n 9\n5 # five\n007\n5\n"), 10), ElementsAre(5, 7, 9));
  EXPECT_TRUE(read_pvs(folder.write("b.txt", ""), 10).empty());
}

struct BadPvs {
  const char* name;
  const char* file;
  std::string bytes;
  ErrorCode code;
  std::string place;
};

void PrintTo(const BadPvs& pvs, std::ostream* out) { *out << pvs.name; }

class BadPvsTest : public testing::TestWithParam<BadPvs> {};

TEST_P(BadPvsTest, IsRefusedAtItsPlace) {
  const SceneFolder folder;
  const auto path = folder.write(GetParam().file, GetParam().bytes);
  const auto thrown = thrown_by([&] { read_pvs(path, 10); });
  EXPECT_EQ(thrown.code, GetParam().code) << thrown.text;
  EXPECT_THAT(thrown.text, HasSubstr(path + GetParam().place));
}

const std::string head = R"({"format": "clues-result/1", )";

INSTANTIATE_TEST_SUITE_P(
    Files, BadPvsTest,
    testing::Values(
        BadPvs{"Word", "a.txt", "1\none\n", ErrorCode::malformed, ":2"},
        BadPvs{"Negative", "a.txt", "-1\n", ErrorCode::malformed, ":1"},
        BadPvs{"Decimal", "a.txt", "1.0\n", ErrorCode::malformed, ":1"},
        BadPvs{"TwoIdsAndAWord", "a.txt", "# c\n1 2 x\n", ErrorCode::malformed, ":2"},
        BadPvs{"TooLarge", "a.txt", "9\n10\n", ErrorCode::index_out_of_range, ":2"},
        BadPvs{"MuchTooLarge", "a.txt", "99999999999999999999999\n", ErrorCode::index_out_of_range, ":1"},
        BadPvs{"EmptyJson", "a.json", "", ErrorCode::malformed, ":1"},
        BadPvs{"CutJson", "a.json", head + "\n\"visible\": [1,\n2", ErrorCode::malformed, ":3"},
        BadPvs{"BareList", "a.json", "[1, 2]", ErrorCode::malformed, ""},
        BadPvs{"HugeNumber", "a.json", head + "\"visible\": [1e999]}", ErrorCode::malformed, ""},
        BadPvs{"NoFormat", "a.json", R"({"visible": [1]})", ErrorCode::malformed, ""},
        BadPvs{"OtherFormat", "a.json", R"({"format": "clues-result/2", "visible": [1]})", ErrorCode::unsupported, ""},
        BadPvs{"NoVisible", "a.json", head + "\"stats\": {}}", ErrorCode::malformed, ""},
        BadPvs{"VisibleNegative", "a.json", head + "\"visible\": [1, -1]}", ErrorCode::malformed, ": visible, entry 1"},
        BadPvs{"VisibleText", "a.json", head + "\"visible\": [\"1\"]}", ErrorCode::malformed, ": visible, entry 0"},
        BadPvs{"VisibleTooLarge", "a.json", head + "\"visible\": [10]}", ErrorCode::index_out_of_range, ""},
        BadPvs{"OtherScene", "a.json", head + "\"scene\": {\"triangles\": 11}, \"visible\": [1]}", ErrorCode::malformed,
               ""}),
    [](const auto& test) { return test.param.name; });

// A result that says what it answers is refused as the answer to something else.
TEST(Pvs, AResultIsOfOneQuestion) {
  const SceneFolder folder;
  const auto path = folder.write("a.clues.json", scene::to_json_text(small_result()));
  const scene::Asked asked{10, "00ff", "sheet", {{1, 2, 3}, {0.1, 0.0, 0x1p-1074}}};
  EXPECT_THAT(read_pvs(path, asked), ElementsAre(1, 5, 9));
  auto other = asked;
  other.scene_sha256 = "00fe";
  EXPECT_THAT(thrown_by([&] { read_pvs(path, other); }).text, HasSubstr("another scene"));
  other = asked;
  other.mode = "solid";
  EXPECT_THAT(thrown_by([&] { read_pvs(path, other); }).text, HasSubstr("mode"));
  other = asked;
  other.cell[0][2] = 4;
  EXPECT_THAT(thrown_by([&] { read_pvs(path, other); }).text, HasSubstr("another cell"));
  const auto silent = folder.write("b.json", R"({"format": "clues-result/1", "visible": [1]})");
  EXPECT_THAT(read_pvs(silent, asked), ElementsAre(1));
}

TEST(SealedResult, IsAResultAndSeesWhatWasChanged) {
  const std::string text = scene::to_json_text(small_result()), sealed = scene::sealed_result(text, "question");
  EXPECT_THAT(scene::parse_result_pvs(sealed, "file", {10, {}, {}, {}}), ElementsAre(1, 5, 9));
  EXPECT_EQ(json::parse(sealed).begin().key(), "answers_sha256");  // the keys are still sorted
  EXPECT_EQ(scene::flaw_of_sealed(sealed, "question"), "");
  EXPECT_THAT(scene::flaw_of_sealed(sealed, "another"), HasSubstr("no answer"));
  EXPECT_THAT(scene::flaw_of_sealed(text, "question"), HasSubstr("no answer"));
  for (std::size_t size = 0; size < sealed.size(); ++size)
    EXPECT_NE(scene::flaw_of_sealed(sealed.substr(0, size), "question"), "") << size;
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    std::string changed = sealed;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_NE(scene::flaw_of_sealed(changed, "question"), "") << i;
  }
}

TEST(Pvs, MissingFileAndFolder) {
  const SceneFolder folder;
  EXPECT_EQ(thrown_by([&] { read_pvs(folder.file("none.json"), 1); }).code, ErrorCode::file_not_found);
  EXPECT_EQ(thrown_by([&] { read_pvs(folder.path(), 1); }).code, ErrorCode::file_unreadable);
}

// The two examples of FIPS 180-4, the empty text, and a million times 'a'.
TEST(Sha256, KnownDigests) {
  const SceneFolder folder;
  const auto digest = [&](std::string_view bytes) { return scene::sha256_of_file(folder.write("file", bytes)); };
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, MissingFileAndFolder) {
  const SceneFolder folder;
  EXPECT_EQ(thrown_by([&] { scene::sha256_of_file(folder.file("none")); }).code, ErrorCode::file_not_found);
  EXPECT_EQ(thrown_by([&] { scene::sha256_of_file(folder.path()); }).code, ErrorCode::file_unreadable);
}

}  // namespace
}  // namespace clues::tests
