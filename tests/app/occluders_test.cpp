// clues occluders (D27): what it writes, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A square of 8x8 at z = 2 (0, 1) and what it hides, triangle 2; a floor that it does not hide (3, 4). The cell's lowest vertices see past the
// square's edges by slope 1, the others by less steep lines: the umbra at height z is the square of side 2 (z + 2).
constexpr const char* kScene =
    "OFF\n11 5 0\n"
    "-4 -4 2\n4 -4 2\n4 4 2\n-4 4 2\n-1 -1 6\n1 -1 6\n0 1 6\n-40 -40 12\n40 -40 12\n40 40 12\n-40 40 12\n"
    "3 0 1 2\n3 0 2 3\n3 4 5 6\n3 7 8 9\n3 7 9 10\n";
constexpr const char* kCell = "box:-1,-1,-1,1,1,0";

class Occluders : public testing::Test {
 protected:
  Occluders() { folder_.write("scene.off", kScene); }

  Ran run(const std::vector<std::string>& more) const {
    return run_clues({"occluders", "scene.off", "--cell", kCell}, more, folder_.path());
  }
  std::string text(const std::string& name) const { return read_all(folder_.path() / name); }

  TestFolder folder_;
};

TEST_F(Occluders, AreExactInJson) {
  const Ran ran = run({"--plane", "z=5", "--plane", "z=1", "-o", "slices.json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json slices = json::parse(text("slices.json"));
  EXPECT_EQ(slices["format"], "clues-occluders/1");
  EXPECT_EQ(slices["scene"]["triangles"], 5);
  ASSERT_EQ(slices["slices"].size(), 2U);
  const json& slice = slices["slices"][0];
  EXPECT_EQ(slice["plane"], "z=5");
  EXPECT_EQ(slice["area_exact"], "196");
  ASSERT_EQ(slice["vertices_exact"].size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    for (const int axis : {0, 1}) EXPECT_EQ(std::abs(slice["vertices"][i][axis].get<double>()), 7);
    EXPECT_EQ(slice["vertices_exact"][i][2], "5");
  }
  EXPECT_EQ(slice["triangles"].size(), 2U);
  EXPECT_EQ(slices["slices"][1]["area_exact"], "0");  // before the square nothing is hidden
  EXPECT_EQ(slices["slices"][1]["triangles"], json::array());
}

TEST_F(Occluders, HideWithTheSceneWhatTheSceneHides) {
  const Ran ran = run({"--plane", "z=5", "--with-scene", "with.off", "--pvs", "with.pvs"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("visible with them: 4 of 5 triangles"));
  EXPECT_EQ(text("with.pvs"), "0\n1\n3\n4\n");
  const Ran map = run_clues({"map", "with.off", "--cell", kCell, "--json"}, folder_.path());
  ASSERT_EQ(map.exit_code, 0) << map.err;
  const json result = json::parse(map.out);
  EXPECT_EQ(result["scene"]["triangles"], 7);  // the ids of the scene stay
  EXPECT_EQ(result["visible"], json({0, 1, 3, 4}));
  EXPECT_EQ(run_clues({"check", "scene.off", "--cell", kCell, "--pvs", "with.pvs"}, folder_.path()).exit_code, 0);
}

TEST_F(Occluders, RefuseWhatTheyCannotWrite) {
  const auto refused = [&](const std::vector<std::string>& arguments, const char* why) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_THAT(ran.err, HasSubstr(why));
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"scene.off"});
  };
  refused({"--plane", "q=1", "-o", "a.off"}, "write x=NUMBER, y=NUMBER or z=NUMBER");
  refused({"--plane", "z=nan", "-o", "a.off"}, "write x=NUMBER, y=NUMBER or z=NUMBER");
  refused({"--plane", "z=5", "-o", "a.txt"}, "*.off (rounded inwards) or *.json (exact)");
  refused({"--plane", "z=5", "--with-scene", "a.obj"}, "is written as *.off");
  refused({"--plane", "z=5", "-o", "a.off", "--pvs", "a.off"}, "two outputs would go to this file");
  refused({"--plane", "z=1", "-o", "a.off"}, "no plane meets the umbra; a.off would be empty");
}

}  // namespace
}  // namespace clues::tests
