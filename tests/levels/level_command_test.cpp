// Levels and glTF files on the command line.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scene/formats/file_bytes.h"
#include "scene/levels/bsp_scene.h"
#include "scene/mesh_io.h"
#include "scene/result.h"
#include "scene/scenes/scene_io.h"
#include "tests/app/program.h"
#include "tests/levels/made_gltf.h"
#include "tests/levels/made_level.h"
#include "tests/levels/real_levels.h"

namespace clues::tests {
namespace {

using testing::HasSubstr;

TEST(LevelCommand, SaysWhatALevelHolds) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  const auto ran = run_clues({"level", "made.bsp", "--json"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_EQ(json["format"], "clues-level/1");
  EXPECT_EQ(json["planar_faces"], 3);
  EXPECT_EQ(json["opaque_faces"], 2);
  EXPECT_EQ(json["patches"], 1);
  EXPECT_EQ(json["hulls"], 2);
  EXPECT_EQ(json["triangles"], 4 + 2 + 32 + 2 + 22) << "the top of the slab is drawn all over";
  EXPECT_EQ(json["counting_triangles"], 40);
  EXPECT_EQ(json["blocking_triangles"], 26);
  EXPECT_EQ(json["cells"], 2);
  EXPECT_THAT(run_clues({"level", "made.bsp"}, folder.path()).out, HasSubstr("Bezier patches drawn"));
}

TEST(LevelCommand, OneListNeedNotHoldWhatIsBeyondItsFarPlane) {
  const TestFolder folder;
  auto level = two_rooms();
  folder.write("made.bsp", level.bytes());
  ASSERT_EQ(run_clues({"level", "made.bsp", "--export", "out"}, folder.path()).exit_code, 0);
  level.lumps[entities_lump] = "{\n\"classname\" \"worldspawn\"\n\"_farplanedist\" \"1024\"\n}\n";
  folder.write("far.bsp", level.bytes());
  const auto judged = [&](const std::string& file, std::vector<std::string> words) {
    words.insert(words.begin(), {"check", file, "--cell", "out/cells/0.in.obj", "--pvs", "out/pvs/0.txt"});
    return run_clues(words, folder.path());
  };
  // What touches the cell is missing however near the far plane is.
  const auto near = judged("made.bsp", {"--far-plane", "0.001", "--json"});
  EXPECT_EQ(near.exit_code, 1);
  EXPECT_THAT(near.err, HasSubstr("left undecided: the sight lines found are longer than 0.001, the far plane"));
  const auto hint = judged("far.bsp", {"--json"});
  EXPECT_EQ(hint.exit_code, 1);
  EXPECT_THAT(hint.err, HasSubstr("compiled with a far plane of 1024: where the list leaves out what is farther away, "
                                  "say --far-plane 1024"));
  const auto counts = [](const Ran& ran) { return nlohmann::json::parse(ran.out)["counts"]; };
  EXPECT_LT(counts(near)["missing_visible"], counts(hint)["missing_visible"]);
  EXPECT_GT(counts(near)["missing_undecided"], counts(hint)["missing_undecided"]);
  EXPECT_EQ(judged("made.bsp", {"--far-plane", "-1"}).exit_code, 2);
}

// What is not drawn stands in no sight line of a depth mesh.
TEST(LevelCommand, MotionWalksThroughWhatIsDrawn) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  const auto drawn = scene::read_drawn_scene(folder.path() / "made.bsp");
  EXPECT_EQ(drawn.triangles.size(), 40U);
  folder.write("drawn.off", scene::to_off_text(drawn));
  const auto walk = [&](const std::string& scene) {
    const auto ran = run_clues({"motion", scene, "--path", "walk:-32,0,32:-20,0,32", "--frames", "3", "--samples",
                                "100", "--csv", scene + ".csv"},
                               folder.path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return read_all(folder.path() / (scene + ".csv"));
  };
  EXPECT_EQ(walk("made.bsp"), walk("drawn.off"));
}

// From the level to a verdict on what it was shipped with, as docs/real-levels.md says.
TEST(LevelCommand, LeadsToAVerdictOnTheShippedLists) {
  const TestFolder folder;
  folder.write("made.bsp", two_rooms().bytes());
  ASSERT_EQ(run_clues({"level", "made.bsp", "--export", "out"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_clues({"level", "made.bsp", "--export", "out"}, folder.path()).exit_code, 2)
      << "not over what is there";
  EXPECT_EQ(read_all(folder.path() / "out/cells.txt"), "# leaf cluster\n0 0\n1 1\n");
  // Room 0 was shipped without the floor of room 1, which is seen through the glass.
  const auto judged =
      run_clues({"check", "made.bsp", "--cell", "out/cells/0.in.obj", "--pvs", "out/pvs/0.txt"}, folder.path());
  EXPECT_EQ(judged.exit_code, 1) << judged.err;
  EXPECT_THAT(judged.out, HasSubstr("verdict: unsound"));
  for (const char* kernel : {"fast", "exact"}) {
    const auto mapped = run_clues(
        {"map", "made.bsp", "--cell", "out/cells/0.out.obj", "--kernel", kernel, "-o", "0.pvs"}, folder.path());
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
    const auto again =
        run_clues({"check", "made.bsp", "--cell", "out/cells/0.in.obj", "--pvs", "0.pvs"}, folder.path());
    EXPECT_EQ(again.exit_code, 0) << kernel << again.out << again.err;
  }
}

// What only a crack between drawn faces shows is in the lists of `clues map`, which leave out sides of hulls, and nobody is accused of lacking it.
TEST(LevelCommand, ChecksOneCellWithAllSidesOfHulls) {
  const TestFolder folder;
  folder.write("slab.bsp", cracked_slab().bytes());
  const std::string above = "box:127,60,40,129,66,48";
  const auto mapped = run_clues({"map", "slab.bsp", "--cell", above, "-o", "slab.clues.json"}, folder.path());
  ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  const auto result = nlohmann::json::parse(read_all(folder.path() / "slab.clues.json"));
  const auto listed = result["visible"].get<std::vector<std::uint32_t>>();
  ASSERT_TRUE(std::find(listed.begin(), listed.end(), 8U) != listed.end() ||
              std::find(listed.begin(), listed.end(), 9U) != listed.end())
      << "the crack shows nothing";
  EXPECT_EQ(result["stats"]["covered_hull_sides_left_out"], 2);
  folder.write("tight.txt", "0 1 2 3\n");
  EXPECT_EQ(run_clues({"check", "slab.bsp", "--cell", above, "--pvs", "tight.txt"}, folder.path()).exit_code, 0);
  const auto judged = run_clues({"check", "slab.bsp", "--cell", above, "--pvs", "slab.clues.json"}, folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_THAT(judged.out, HasSubstr("loose"));
  folder.write("hole.txt", "0 1 2\n");
  EXPECT_EQ(run_clues({"check", "slab.bsp", "--cell", above, "--pvs", "hole.txt"}, folder.path()).exit_code, 1);
}

TEST(LevelCommand, WhatTakesEverythingForOpaqueRefusesGlass) {
  const TestFolder folder;
  auto glass = one_triangle();
  glass.add("materials", {{"alphaMode", "BLEND"}});
  glass.json["meshes"][0]["primitives"][0]["material"] = 0;
  folder.write("glass.glb", glass.glb());
  folder.write("plain.gltf", one_triangle().text());
  const std::string cell = "box:0,0,1,1,1,2";
  const auto refused = run_clues({"precision", "glass.glb", "--cell", cell}, folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("1 triangles do not block"));
  for (const auto& option : std::vector<std::vector<std::string>>{
           {"--map", "--render-states"}, {"--fragments", "f.obj"}, {"--mode", "solid"}, {"--refine", "cell"}}) {
    std::vector<std::string> words{"map", "glass.glb", "--cell", cell};
    words.insert(words.end(), option.begin(), option.end());
    const auto map = run_clues(words, folder.path());
    EXPECT_EQ(map.exit_code, 2) << option[0];
    EXPECT_THAT(map.err, HasSubstr("leave out")) << option[0];
  }
  EXPECT_EQ(run_clues({"map", "glass.glb", "--cell", cell, "-o", "a.pvs"}, folder.path()).exit_code, 0);
  EXPECT_EQ(read_all(folder.path() / "a.pvs"), "0\n");
  EXPECT_EQ(run_clues({"map", "plain.gltf", "--cell", cell, "--map", "-o", "b.clues.json"}, folder.path()).exit_code,
            0);
}

TEST(LevelCommand, RefusesWhatIsNoLevelInOneLine) {
  const TestFolder folder;
  auto made = two_rooms();
  made.put_word(nodes_lump, 1, 0);
  folder.write("bad.bsp", made.bytes());
  for (const auto& words : std::vector<std::vector<std::string>>{{"level", "bad.bsp", "--export", "out"},
                                                                 {"map", "bad.bsp", "--cell", "box:0,0,0,1,1,1"}}) {
    const auto ran = run_clues(words, folder.path());
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("bad.bsp: node 0: the BSP tree reaches it twice"));
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"bad.bsp"});
}

TEST(RealLevelsLong, AreAllRead) {
  const TestFolder folder;
  const auto [levels, why_not] = real_levels(folder);
  if (levels.empty()) GTEST_SKIP() << why_not;
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(levels)) {
    if (entry.path().extension() != ".bsp") continue;
    SCOPED_TRACE(entry.path().string());
    const auto level = scene::parse_bsp(scene::read_file_bytes(entry.path()), entry.path().string());
    const auto scene = scene::scene_of_level(level);
    const auto cells = scene::cells_of_level(level);
    EXPECT_GT(scene.hulls, 10U);
    EXPECT_GE(cells.size(), level.visibility.clusters);
    for (const auto& cell : cells) {
      EXPECT_FALSE(cell.outer.empty());
      EXPECT_LT(cell.cluster, level.visibility.clusters);
    }
    for (std::uint32_t c = 0; c < level.visibility.clusters; c += 97) {
      for (const auto t : scene::shipped_set(level, scene, c)) EXPECT_TRUE(scene.scene.counting(t));
    }
    ++read;
  }
  EXPECT_EQ(read, 50);
}

}  // namespace
}  // namespace clues::tests
