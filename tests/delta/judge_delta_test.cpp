// The judge of transitions (D24): wrong ones are caught. Right ones: delta_identities_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "fuzz/trials/deltas_trial.h"
#include "reference/delta/delta.h"
#include "scene/messages/error.h"
#include "tests/app/program.h"
#include "tests/reference/support.h"
#include "validate/stream/judge_delta.h"

namespace clues::test {
namespace {

using fuzz::map_file_of;
using reference::SeenFrom;
using validate::DeltaRecord;
using validate::MapFile;

// Scene P with a triangle that only one of the cells sees, and one wrong thing at a time.
class PlantedDelta : public ::testing::Test {
 protected:
  PlantedDelta() {
    SceneBuilder scene;
    scene.plate(-1, -1, 1, 1, 4);
    scene.plate(-20, -20, 20, 20, 8);
    scene.triangle({-0.9, -0.1, 5}, {-0.8, -0.1, 5}, {-0.9, 0.1, 5});
    scene.triangle({1.15, -0.1, 5}, {1.2, -0.1, 5}, {1.15, 0.1, 5});
    mesh_ = scene.mesh();
    const auto a = box_cell(-2, -1, -1, 0, 1, 0), b = box_cell(0, -1, -1, 2, 1, 0);
    from_ = map_file_of(map_of(mesh_, a));
    to_ = map_file_of(map_of(mesh_, b));
    delta_ = validate::record_of(reference::delta_of(mesh_, a, b, {}), true);
    back_ = validate::record_of(reference::delta_of(mesh_, b, a, {}), true);
  }
  std::size_t findings() const { return validate::judge_delta(mesh_, delta_, from_, to_).findings.size(); }
  // The first fragment with this label.
  validate::DeltaFragment& fragment(SeenFrom seen) {
    return *std::find_if(delta_.fragments.begin(), delta_.fragments.end(),
                         [&](const auto& f) { return f.seen == seen && f.triangle >= 2; });
  }

  scene::TriangleMesh mesh_;
  MapFile from_, to_;
  DeltaRecord delta_, back_;
};

TEST_F(PlantedDelta, TheRightOneIsRight) {
  EXPECT_EQ(findings(), 0U);
  EXPECT_TRUE(validate::judge_reverse(delta_, back_).empty());
  EXPECT_FALSE(delta_.plus.empty() && delta_.minus.empty());
}

TEST_F(PlantedDelta, ExchangedLabels) {
  fragment(SeenFrom::to).seen = SeenFrom::from;
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, AFragmentThatBothSeeCalledNew) {
  fragment(SeenFrom::both).seen = SeenFrom::to;
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, ANewFragmentThatIsMissing) {
  delta_.fragments.erase(delta_.fragments.begin() + (&fragment(SeenFrom::to) - delta_.fragments.data()));
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, AFragmentTwice) {
  const auto copy = fragment(SeenFrom::both);
  delta_.fragments.push_back(copy);
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, AFragmentTurnedOver) {
  auto& f = fragment(SeenFrom::both);
  std::swap(f.corners[0], f.corners[1]);
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, ACornerMovedByABitInThePlane) {
  fragment(SeenFrom::to).corners[0][0] += validate::Rational("1/1000000000000000000000");
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, AFragmentOnTheOtherSide) {
  auto& f = fragment(SeenFrom::both);
  f.front = !f.front;
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, PacketsExchanged) {
  std::swap(delta_.plus, delta_.minus);
  EXPECT_GT(findings(), 0U);
}

TEST_F(PlantedDelta, APlusTooFew) {
  auto& packet = delta_.plus.empty() ? delta_.minus : delta_.plus;
  packet.pop_back();
  EXPECT_GT(findings(), 0U);
}

// Map, list and packets agree, and all of them leave out what the regions show.
TEST_F(PlantedDelta, ATriangleThatIsSeenAndInNoList) {
  for (auto* list : {&from_.visible, &delta_.from.visible, &delta_.minus}) std::erase(*list, 2U);
  for (auto* list : {&to_.visible, &delta_.to.visible, &delta_.plus}) std::erase(*list, 2U);
  EXPECT_GT(findings(), 0U);
  delta_.has_fragments = false;
  delta_.fragments.clear();
  EXPECT_GT(findings(), 0U);  // by the regions of the maps alone
}

TEST_F(PlantedDelta, DoublesThatAreNoRoundings) {
  const tests::TestFolder folder;
  delta_.scene_triangles = mesh_.triangles.size();
  const std::string text = validate::to_json_text(delta_);
  delta_ = validate::read_delta(folder.write("d.json", text), mesh_.triangles.size());
  EXPECT_EQ(findings(), 0U);
  ASSERT_FALSE(delta_.vertices.empty());
  double& x = delta_.vertices[0].rounded[0];
  x = std::nextafter(std::nextafter(x, 100), 100);
  EXPECT_EQ(findings(), 1U);
  for (const char* without : {"vertices", "vertices_exact"}) {
    auto json = nlohmann::json::parse(text);
    json["fragments"].erase(without);
    EXPECT_THROW(validate::read_delta(folder.write("d.json", json.dump()), mesh_.triangles.size()), scene::Error);
  }
  auto json = nlohmann::json::parse(text);
  json["fragments"]["vertices"].erase(0);
  EXPECT_THROW(validate::read_delta(folder.write("d.json", json.dump()), mesh_.triangles.size()), scene::Error);
}

TEST_F(PlantedDelta, TheWayBackOfAnother) {
  EXPECT_FALSE(validate::judge_reverse(delta_, delta_).empty());
  fragment(SeenFrom::from).seen = SeenFrom::both;
  EXPECT_FALSE(validate::judge_reverse(delta_, back_).empty());
}

// The way back has the right borders of what changes, and lists of nothing.
TEST(DeltaCommands, TheWayBackIsJudgedAsAWhole) {
  const tests::TestFolder folder;
  folder.write("screen.off", tests::screen_scene);
  const std::string a = "box:-0.25,-0.25,-0.25,0,0.25,0", b = "box:0,-0.25,-0.25,0.25,0.25,0";
  for (const auto& [cell, file] : {std::pair(a, "a.json"), {b, "b.json"}})
    ASSERT_EQ(tests::run_clues({"map", "screen.off", "--cell", cell, "--map", "-o", file}, folder.path()).exit_code, 0);
  for (const auto& [from, to, file] : {std::tuple(a, b, "ab.json"), {b, a, "ba.json"}}) {
    ASSERT_EQ(
        tests::run_clues({"delta", "screen.off", "--from", from, "--to", to, "--fragments", "-o", file}, folder.path())
            .exit_code,
        0);
  }
  const std::vector<std::string> check{"delta",  "check",    "screen.off", "--delta", "ab.json", "--from-map",
                                       "a.json", "--to-map", "b.json",     "--back",  "ba.json"};
  const auto right = tests::run_clues(check, folder.path());
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  auto back = nlohmann::json::parse(tests::read_all(folder.path() / "ba.json"));
  back["from"]["visible"] = back["to"]["visible"] = nlohmann::json::array();
  folder.write("ba.json", back.dump());
  const auto wrong = tests::run_clues(check, folder.path());
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
  EXPECT_NE(wrong.out.find("wrong: the way back: the list of the first cell"), std::string::npos) << wrong.out;
}

}  // namespace
}  // namespace clues::test
