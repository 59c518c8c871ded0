// Commands on a scene in which some triangles do not block: a pane (0), a wall behind it (1), and behind the wall a screen (2) and a small pane (3).
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"
#include "tests/levels/made_gltf.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string cell = "box:-1,-1,0,1,1,1";

// `pane`: what the material of the panes says of them.
std::string wall_and_panes(const json& pane) {
  MadeGltf made;
  made.add("materials", pane);
  const auto add = [&](double size, double z, bool is_pane) {
    const auto position = made.add_positions({{-size, -size, z}, {size, -size, z}, {0, size, z}});
    json primitive = {{"attributes", {{"POSITION", position}}}};
    if (is_pane) primitive["material"] = 0;
    made.add_node(made.add_mesh(primitive));
  };
  add(90, 3, true);
  add(90, 4, false);
  add(0.5, 6, false);
  add(0.5, 5, true);
  return made.text();
}

struct FlaggedCommands : testing::Test {
  FlaggedCommands() {
    folder.write("panes.gltf", wall_and_panes({{"alphaMode", "BLEND"}}));
    folder.write("walls.gltf", wall_and_panes({{"alphaMode", "OPAQUE"}}));
  }
  const TestFolder folder;
};

TEST_F(FlaggedCommands, MapHasTheRegionsOfPanesAndOfWhatIsBehind) {
  const auto ran = run_clues({"map", "panes.gltf", "--cell", cell, "--map", "--json"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto result = json::parse(ran.out);
  EXPECT_EQ(result["visible"], (std::vector<int>{0, 1}));
  std::map<int, bool> seen;
  for (const auto& region : result["regions"]) seen[region["triangle"]] |= region["visible"].get<bool>();
  EXPECT_EQ(seen, (std::map<int, bool>{{0, true}, {1, true}, {2, false}, {3, false}}));
  for (const auto& face : result["mesh"]["faces"]) EXPECT_FALSE(face["regions"].empty());
  for (const auto& edge : result["mesh"]["edges"]) {
    for (const auto& f : edge["faces"]) EXPECT_LT(f.get<std::size_t>(), result["mesh"]["faces"].size());
  }
  EXPECT_EQ(
      run_clues({"map", "panes.gltf", "--cell", cell, "--map", "--render-states", "--json"}, folder.path()).exit_code,
      2);
}

TEST_F(FlaggedCommands, UmbraIsOfWhatBlocks) {
  const auto verify = [&](const char* scene, const char* umbra) {
    return run_clues({"verify", scene, "--cell", cell, "--umbra", umbra, "--list"}, folder.path());
  };
  ASSERT_EQ(run_clues({"map", "panes.gltf", "--cell", cell, "--umbra", "u.json"}, folder.path()).exit_code, 0);
  const auto verified = verify("panes.gltf", "u.json");
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("hidden triangles: 2 of 4\n2\n3\n"));
  // An umbra for which panes are walls is one of the scene with walls only.
  ASSERT_EQ(run_clues({"map", "walls.gltf", "--cell", cell, "--umbra", "w.json"}, folder.path()).exit_code, 0);
  EXPECT_EQ(verify("walls.gltf", "w.json").exit_code, 0);
  const auto forged = verify("panes.gltf", "w.json");
  EXPECT_EQ(forged.exit_code, 1);
  EXPECT_THAT(forged.out, HasSubstr("lies in triangle 0, which does not block"));
}

TEST_F(FlaggedCommands, QueryLooksThroughPanes) {
  folder.write("points.txt", "0 0 3.5\n0 0 3\n0 0 5.5\n");
  const auto ran =
      run_clues({"query", "panes.gltf", "--cell", cell, "--points", "points.txt", "--json"}, folder.path());
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto points = json::parse(ran.out)["points"];
  for (const int i : {0, 1}) {
    EXPECT_EQ(points[i]["place"], "space") << "a pane is air";
    EXPECT_EQ(points[i]["answers"][0]["sight"], "visible");
  }
  EXPECT_EQ(points[2]["answers"][0]["sight"], "occluded");
  EXPECT_EQ(points[2]["answers"][0]["covered_by"], std::vector<int>{1}) << "named as in the scene";
}

TEST_F(FlaggedCommands, NothingBlocksAtAll) {
  auto only_pane = one_triangle();
  only_pane.add("materials", {{"alphaMode", "BLEND"}});
  only_pane.json["meshes"][0]["primitives"][0]["material"] = 0;
  folder.write("pane.gltf", only_pane.text());
  folder.write("points.txt", "0.1 0.1 -1\n");
  const std::string above = "box:0,0,1,1,1,2";
  const auto mapped = run_clues({"map", "pane.gltf", "--cell", above, "--map", "--json"}, folder.path());
  EXPECT_EQ(mapped.exit_code, 0) << mapped.err;
  EXPECT_EQ(json::parse(mapped.out)["visible"], std::vector<int>{0});
  const auto asked =
      run_clues({"query", "pane.gltf", "--cell", above, "--points", "points.txt", "--json"}, folder.path());
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_EQ(json::parse(asked.out)["points"][0]["answers"][0]["sight"], "visible");
  EXPECT_EQ(run_clues({"map", "pane.gltf", "--cell", above, "--umbra", "u.json"}, folder.path()).exit_code, 0);
  const auto verified = run_clues({"verify", "pane.gltf", "--cell", above, "--umbra", "u.json"}, folder.path());
  EXPECT_THAT(verified.out, HasSubstr("hidden triangles: 0 of 1"));
}

}  // namespace
}  // namespace clues::tests
