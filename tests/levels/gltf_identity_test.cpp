// D1: a .gltf or .glb whose buffer beside it was exchanged is another scene, whatever names the first one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "scene/result.h"
#include "scene/scenes/scene_identity.h"
#include "tests/app/program.h"
#include "tests/levels/made_gltf.h"

namespace clues::tests {
namespace {

using nlohmann::json;

// A target behind a wall, which is one of two buffers: moved aside it shows the target, and no byte of the .gltf has changed.
struct GltfIdentity : testing::Test {
  GltfIdentity() {
    MadeGltf made;
    made.add_node(
        made.add_mesh({{"attributes", {{"POSITION", made.add_positions({{-1, -1, 4}, {1, -1, 4}, {0, 1, 4}})}}}}));
    made.add_node(
        made.add_mesh({{"attributes", {{"POSITION", made.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}}}));
    json document = json::parse(made.text());
    document["buffers"][0]["uri"] = "target.bin";
    document["buffers"].push_back({{"uri", "the%20wall.bin"}, {"byteLength", 36}});
    document["bufferViews"][document["accessors"][1]["bufferView"].get<std::size_t>()] = {{"buffer", 1},
                                                                                          {"byteLength", 36}};
    folder.write("scene.gltf", document.dump());
    folder.write("target.bin", made.buffer);
    document["buffers"][0].erase("uri");
    folder.write("scene.glb", glb_of(document.dump(), made.buffer));
    put_wall(0);
  }
  void put_wall(double aside) const {
    folder.write("the wall.bin", floats({aside - 90, -90, 2, aside + 90, -90, 2, aside, 90, 2}));
  }
  std::string identity() const { return scene::sha256_of_scene(folder.file("scene.gltf")); }
  Ran run(const std::vector<std::string>& words) const { return run_clues(words, folder.path()); }

  const TestFolder folder;
  const std::string cell = "box:-1,-1,0,1,1,1";
};

TEST_F(GltfIdentity, IsOfAllFilesOfBuffers) {
  const auto sum = [&](const char* file) { return scene::sha256_of_file(folder.file(file)) + "\n"; };
  EXPECT_EQ(identity(), scene::sha256_of(sum("scene.gltf") + sum("target.bin") + sum("the wall.bin")));
  const auto before = identity();
  put_wall(200);
  EXPECT_NE(identity(), before);
  std::filesystem::remove(folder.file("target.bin"));
  EXPECT_EQ(identity(), scene::sha256_of(sum("scene.gltf") + "missing\n" + sum("the wall.bin")));
}

TEST_F(GltfIdentity, IsOfTheFilesBesideABinaryOneToo) {
  const auto sum = [&](const char* file) { return scene::sha256_of_file(folder.file(file)) + "\n"; };
  EXPECT_EQ(scene::sha256_of_scene(folder.file("scene.glb")), scene::sha256_of(sum("scene.glb") + sum("the wall.bin")));
}

TEST_F(GltfIdentity, IsOfTheFileWhereAllIsInIt) {
  for (const auto& [name, bytes] :
       {std::pair("whole.gltf", one_triangle().text()), {"whole.glb", one_triangle().glb()}}) {
    folder.write(name, bytes);
    EXPECT_EQ(scene::sha256_of_scene(folder.file(name)), scene::sha256_of(bytes));
  }
  // A buffer outside of the folder is no part of the scene: geometry in it is refused.
  json outside = json::parse(one_triangle().text());
  outside["buffers"].push_back({{"uri", "../texture.bin"}, {"byteLength", 4}});
  folder.write("whole.gltf", outside.dump());
  EXPECT_EQ(scene::sha256_of_scene(folder.file("whole.gltf")), scene::sha256_of(outside.dump()));
}

class GltfIdentityOf : public GltfIdentity, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Both, GltfIdentityOf, testing::Values("scene.gltf", "scene.glb"));

TEST_P(GltfIdentityOf, WhatWasMadeOfTheSceneBeforeIsRefused) {
  const std::string file = GetParam();
  const std::string grid = "grid:2x1x1:" + cell;
  const std::vector<std::vector<std::string>> makers{
      {"map", file, "--cell", cell, "-o", "list.clues.json"},
      {"map", file, "--cells", grid, "-o", "maps"},
      {"bake", file, "--cells", grid, "-o", "all.bake"},
      {"walk", file, "--bake", "all.bake", "--steps", "3", "-o", "walk.stream.jsonl"},
      {"delta", "contours", file, "--parent", cell, "--cells", grid, "-o", "all.contours"},
  };
  const std::vector<std::vector<std::string>> users{
      {"check", file, "--cell", cell, "--pvs", "list.clues.json"},
      {"check", file, "--all-cells", "--bake", "all.bake"},
      {"map", file, "--cells", grid, "-o", "maps", "--resume"},
      {"bake", file, "--cells", grid, "-o", "all.bake"},
      {"walk", file, "--bake", "all.bake", "--steps", "3"},
      {"conform", "--stream", "walk.stream.jsonl", "--scene", file, "--bake", "all.bake"},
      {"delta", "decode", file, "--contours", "all.contours", "--cell", "1"},
  };
  const auto expect_all = [&](const std::vector<std::vector<std::string>>& commands, int exit_code) {
    for (const auto& words : commands) {
      const auto ran = run(words);
      EXPECT_EQ(ran.exit_code, exit_code) << words[0] << " " << words[1] << "\n" << ran.out << ran.err;
    }
  };
  expect_all(makers, 0);
  expect_all(users, 0);
  put_wall(200);
  expect_all(users, 2);
}

}  // namespace
}  // namespace clues::tests
