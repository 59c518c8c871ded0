// The seed corpus of the coverage-guided targets, replayed without libFuzzer: nothing breaks a promise, and the seeds reach what lies behind the first checks.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fuzz/oracles/oracle.h"
#include "fuzz/targets/scene_bytes.h"
#include "fuzz/targets/targets.h"
#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"

namespace clues::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> seeds_of(const std::string& target) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(CLUES_SOURCE_DIR) / "fuzz" / "corpus" / target))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Corpus : public testing::TestWithParam<const char*> {};

TEST_P(Corpus, KeepsAllPromises) {
  const Target& target = target_named(GetParam());
  int accepted = 0, refused = 0;
  for (const auto& file : seeds_of(target.name)) {
    SCOPED_TRACE(file.string());
    EXPECT_NO_THROW(++(target.run(scene::read_file_bytes(file)) ? accepted : refused));
  }
  EXPECT_GE(accepted, 2);
  EXPECT_GE(refused, 1);
}

// Cut short anywhere, a file is accepted or refused, and nothing else.
TEST_P(Corpus, KeepsAllPromisesWhenCutShort) {
  const Target& target = target_named(GetParam());
  if (target.run == scene_to_verdict) GTEST_SKIP() << "slow, and any bytes are a scene";
  for (const auto& file : seeds_of(target.name)) {
    SCOPED_TRACE(file.string());
    const std::string bytes = scene::read_file_bytes(file);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 64)
      EXPECT_NO_THROW(target.run(bytes.substr(0, size))) << size;
  }
}

std::vector<const char*> names() {
  std::vector<const char*> out;
  for (const Target& t : all_targets()) out.push_back(t.name);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, testing::ValuesIn(names()),
                         [](const auto& one) { return std::string(one.param); });

TEST(SceneBytes, AreReadAsTheyWereWritten) {
  Case scene{"made", 0, 0, {}, {}};
  scene.mesh.points = {{0, -2047.9375, 1}, {1, 0.0625, 0}, {3, 4, 5}, {-1, -1, -1}};
  scene.mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  scene.mesh.face_of = {0, 1};
  scene.cell = {{-3, 0, 0}, {-4, 0, 0}};
  const std::string bytes = bytes_of_scene(scene).value();
  const Case again = scene_of_bytes(bytes);
  EXPECT_EQ(again.mesh.points, scene.mesh.points);
  EXPECT_EQ(again.mesh.triangles, scene.mesh.triangles);
  EXPECT_EQ(again.mesh.face_of, scene.mesh.face_of);
  EXPECT_EQ(again.cell, scene.cell);
  const Case moved = scene_of_bytes(bytes + "\x01\xff");  // coordinate 1, one ulp down
  EXPECT_LT(moved.mesh.points[0][1], scene.mesh.points[0][1]);
  EXPECT_EQ(bytes_of_scene(moved), std::nullopt);
  EXPECT_EQ(scene_of_bytes("").mesh.triangles.size(), 1U);
}

TEST(Targets, AnUnknownNameIsRefused) { EXPECT_THROW(target_named("none"), scene::Error); }

}  // namespace
}  // namespace clues::fuzz
