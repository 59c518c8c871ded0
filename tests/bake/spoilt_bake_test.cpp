// What clues bake refuses before it begins, and what clues check says of cells that nobody judged.
#include <gmock/gmock.h>

#include <filesystem>

#include "scene/bakes/bake_store.h"
#include "tests/app/program.h"
#include "tests/levels/made_level.h"

namespace clues::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::vector<std::string> baking(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"bake", "scene.off", "--cells", "grid:2x1x1:box:-0.3,-0.25,-0.25,0.3,0.25,0",
                                 "-o",   out};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void expect_refused(const TestFolder& folder, const std::vector<std::string>& words, const char* why) {
  const auto before = folder.names();
  const auto ran = run_clues(words, folder.path());
  EXPECT_EQ(ran.exit_code, 2) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr(why));
  EXPECT_EQ(folder.names(), before) << "something was written";
}

TEST(SpoiltBake, BadExportFoldersAreRefusedAtOnce) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  fs::create_directory(folder.path() / "full");
  folder.write("full/file", "of somebody");
  fs::create_directory(folder.path() / "empty");
  expect_refused(folder, baking("b.bake", {"--export", "full"}), "full: is not empty");
  expect_refused(folder, baking("b.bake", {"--export", "scene.off"}), "scene.off: is read by this command too");
  expect_refused(folder, baking("b.bake", {"--export", "full/file"}), "cannot write into this folder");
  expect_refused(folder, baking("b.bake", {"--export", "missing/folder"}), "no such folder");
  expect_refused(folder, baking("b.bake", {"--export", "b.bake"}), "two outputs would go to this file");
  expect_refused(folder, baking("empty/b.bake", {"--export", "empty"}), "empty: must be empty when");
  EXPECT_TRUE(fs::is_empty(folder.path() / "empty"));
  EXPECT_EQ(run_clues(baking("b.bake", {"--export", "empty/"}), folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues(baking("b.bake", {"--export", "new/"}), folder.path()).exit_code, 0);
}

TEST(SpoiltBake, BadStoresToMergeAreRefusedAtOnce) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  folder.write("text", "not a store, but a long enough text to be taken for something by somebody\n");
  ASSERT_EQ(run_clues({"bake", "scene.off", "--cells", "grid:1x1x1:box:0,0,0,1,1,1", "-o", "other.bake"}, folder.path())
                .exit_code,
            0);
  ASSERT_EQ(run_clues(baking("shard.bake", {"--shard", "1/2"}), folder.path()).exit_code, 0);
  expect_refused(folder, baking("b.bake", {"--merge", "shard.bake", "missing.bake"}), "missing.bake: no such file");
  expect_refused(folder, baking("b.bake", {"--merge", "shard.bake", "text"}), "file is not a database");
  expect_refused(folder, baking("b.bake", {"--merge", "other.bake"}), "of other cells or options");
  expect_refused(folder, baking("b.bake", {"--merge", "b.bake"}), "b.bake: is read by this command too");
  EXPECT_EQ(run_clues(baking("b.bake", {"--merge", "shard.bake"}), folder.path()).exit_code, 0);
}

TEST(SpoiltBake, HeightsOfTooManyBoxesAreRefused) {
  const TestFolder folder;
  folder.write("scene.off", "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n");
  for (const char* cells : {"auto:1:1e9", "auto:1:1e300", "auto:1e-9:1"})
    expect_refused(folder, {"bake", "scene.off", "--cells", cells, "-o", "b.bake"}, "take larger ones");
  folder.write("scene.off", "OFF\n3 1 0\n1e30 0 0\n1.1e30 0 0\n1e30 1e29 0\n3 0 1 2\n");
  expect_refused(folder, {"bake", "scene.off", "--cells", "auto:1e29:1e300", "-o", "b.bake"}, "take larger ones");
  folder.write("scene.off", "OFF\n3 1 0\n0 0 1e30\n4 0 1e30\n0 4 1e30\n3 0 1 2\n");
  expect_refused(folder, {"bake", "scene.off", "--cells", "auto:1", "-o", "b.bake"}, "away from the origin");
}

TEST(SpoiltBake, ALinkStaysAndItsFileIsReplaced) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  fs::create_directory(folder.path() / "real");
  fs::create_symlink("real/middle.bake", folder.path() / "link.bake");
  fs::create_symlink(folder.path() / "real/a.bake", folder.path() / "real/middle.bake");
  for (const char* what : {"a link to nothing", "a link to a finished store"}) {
    SCOPED_TRACE(what);
    ASSERT_EQ(run_clues(baking("link.bake"), folder.path()).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link.bake"));
    EXPECT_TRUE(fs::is_symlink(folder.path() / "real/middle.bake"));
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder.path() / "real/a.bake")));
    EXPECT_EQ(scene::FinishedBake(folder.path() / "real/a.bake").plan().cells.size(), 2U);
    EXPECT_THAT(folder.names(), ElementsAre("link.bake", "real", "scene.off"));
  }
}

MadeLevel rooms_that_see_each_other() {
  MadeLevel level = two_rooms();
  level.lumps[visibility_lump][8] = '\x03';
  return level;
}

TEST(SpoiltBake, CellsThatNobodyJudgedAreNotFine) {
  const TestFolder folder;
  auto level = rooms_that_see_each_other();
  folder.write("fine.bsp", level.bytes());
  EXPECT_EQ(run_clues({"check", "fine.bsp", "--all-cells"}, folder.path()).exit_code, 0);
  // Between the planes x = 1 and x + 2^-100 y = 1 lie no doubles.
  level.add_plane(1, 0, 0, 1);
  level.add_plane(1, 0x1p-100F, 0, 1);
  const auto planes = level.count(planes_lump, 16);
  level.lumps[nodes_lump].resize(std::size_t{3} * 36);
  level.put_word(nodes_lump, 2, 1);
  const auto put_node = [&](std::size_t node, std::uint32_t plane, std::int32_t front, std::int32_t behind) {
    level.put_word(nodes_lump, 9 * node, plane);
    level.put_word(nodes_lump, 9 * node + 1, static_cast<std::uint32_t>(front));
    level.put_word(nodes_lump, 9 * node + 2, static_cast<std::uint32_t>(behind));
  };
  put_node(1, planes - 2, -1, 2);
  put_node(2, planes - 1, -3, -4);
  level.lumps[leaves_lump].resize(std::size_t{4} * 48);
  folder.write("sliver.bsp", level.bytes());
  const auto sliver = run_clues({"check", "sliver.bsp", "--all-cells"}, folder.path());
  EXPECT_EQ(sliver.exit_code, 3) << sliver.err;
  EXPECT_THAT(sliver.out, HasSubstr("1 slivers without an inner cell were not judged"));

  level = rooms_that_see_each_other();
  for (const std::size_t leaf : {0, 1}) level.put_word(leaves_lump, 12 * leaf, 0xFFFFFFFFU);
  folder.write("none.bsp", level.bytes());
  const auto none = run_clues({"check", "none.bsp", "--all-cells"}, folder.path());
  EXPECT_EQ(none.exit_code, 3) << none.err;
  EXPECT_THAT(none.out, HasSubstr("no cell was judged"));
}

TEST(SpoiltBake, OfAnotherNumberOfTrianglesIsNotJudged) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  ASSERT_EQ(run_clues(baking("b.bake"), folder.path()).exit_code, 0);
  scene::Database(folder.path() / "b.bake", scene::Database::Access::write, "the bake", "name another")
      .run("UPDATE about SET value = '6' WHERE name = 'triangles'");
  expect_refused(folder, {"check", "scene.off", "--all-cells", "--bake", "b.bake"},
                 "b.bake: is of 6 triangles, and scene.off has 5");
}

// A judge that looks from elsewhere accuses nobody; and who goes by deltas has other lists than those that are judged.
TEST(SpoiltBake, WithInnerCellsElsewhereOrOtherDeltasIsNotJudged) {
  const TestFolder folder;
  folder.write("scene.off", screen_scene);
  ASSERT_EQ(run_clues(baking("b.bake"), folder.path()).exit_code, 0);
  struct Spoilt {
    const char *sql, *complaint;
  };
  for (const auto& [sql, complaint] :
       {Spoilt{"UPDATE cells SET inner = (SELECT points FROM cells WHERE id = 1) WHERE id = 0", "is not within it"},
        {"UPDATE deltas SET appears = (SELECT list FROM cells WHERE id = 0)", "is not what the two lists say"},
        {"UPDATE deltas SET neighbour = 77 WHERE cell = 0 AND neighbour = 1", "there is no such cell"}}) {
    std::filesystem::copy(folder.path() / "b.bake", folder.path() / "spoilt.bake",
                          std::filesystem::copy_options::overwrite_existing);
    scene::Database(folder.path() / "spoilt.bake", scene::Database::Access::write, "the bake", "name another").run(sql);
    expect_refused(folder, {"check", "scene.off", "--all-cells", "--bake", "spoilt.bake"}, complaint);
  }
  scene::Database(folder.path() / "b.bake", scene::Database::Access::write, "the bake", "name another")
      .run("UPDATE cells SET inner = points WHERE id = 0");
  EXPECT_EQ(run_clues({"check", "scene.off", "--all-cells", "--bake", "b.bake"}, folder.path()).exit_code, 0);
}

}  // namespace
}  // namespace clues::tests
