// glTF 2.0: what each feature makes of positions, triangles, flags and names.
#include <gmock/gmock.h>
#include <tiny_gltf.h>

#include <chrono>
#include <sstream>

#include "scene/gltf/gltf_reader.h"
#include "scene/messages/warning.h"
#include "scene/scenes/scene_io.h"
#include "tests/levels/made_gltf.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using scene::FlaggedMesh;
using scene::Point;
using scene::Triangle;
using testing::ElementsAre;
using testing::HasSubstr;

std::string no_file(const std::string& path) {
  throw scene::Error(scene::ErrorCode::file_not_found, path + ": there is none");
}

FlaggedMesh read(const std::string& bytes) { return scene::read_gltf(bytes, "made.gltf", no_file); }

std::vector<std::vector<Point>> corners_of(const FlaggedMesh& mesh) {
  std::vector<std::vector<Point>> corners;
  for (const auto& [a, b, c] : mesh.mesh.triangles)
    corners.push_back({mesh.mesh.points[a], mesh.mesh.points[b], mesh.mesh.points[c]});
  return corners;
}

const std::vector<Point> five{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.1F, 0.2F, 3}};

MadeGltf with_primitive(int mode, bool indices, int component) {
  MadeGltf made;
  json primitive = {{"attributes", {{"POSITION", made.add_positions(five)}}}};
  if (mode != 4) primitive["mode"] = mode;
  if (indices) primitive["indices"] = made.add_indices({4, 0, 1, 2, 3, 1}, component);
  made.add_node(made.add_mesh(primitive));
  return made;
}

TEST(Gltf, ReadsListsWithIndicesOfEverySize) {
  for (const int component : {5121, 5123, 5125}) {
    for (const bool binary : {false, true}) {
      const auto made = with_primitive(4, true, component);
      const auto mesh = read(binary ? made.glb() : made.text());
      EXPECT_THAT(mesh.mesh.triangles, ElementsAre(Triangle{4, 0, 1}, Triangle{2, 3, 1}));
      EXPECT_EQ(bits_of(mesh.mesh.points), bits_of(five));
      EXPECT_TRUE(mesh.is_plain());
    }
  }
}

TEST(Gltf, ReadsStripsAndFans) {
  EXPECT_THAT(read(with_primitive(5, true, 5123).text()).mesh.triangles,
              ElementsAre(Triangle{4, 0, 1}, Triangle{0, 2, 1}, Triangle{1, 2, 3}, Triangle{2, 1, 3}));
  EXPECT_THAT(read(with_primitive(6, true, 5123).text()).mesh.triangles,
              ElementsAre(Triangle{0, 1, 4}, Triangle{1, 2, 4}, Triangle{2, 3, 4}, Triangle{3, 1, 4}));
  EXPECT_THAT(read(with_primitive(5, false, 0).text()).mesh.triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}, Triangle{2, 3, 4}));
  EXPECT_THAT(read(with_primitive(6, false, 0).text()).mesh.triangles,
              ElementsAre(Triangle{1, 2, 0}, Triangle{2, 3, 0}, Triangle{3, 4, 0}));
}

TEST(Gltf, ReadsAListWithoutIndices) {
  EXPECT_THAT(read(one_triangle().text()).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Gltf, LeavesOutPointsAndLinesWithAWarning) {
  auto made = one_triangle();
  for (const int mode : {0, 1, 2, 3}) {
    made.add_node(made.add_mesh({{"attributes", {{"POSITION", 0}}}, {"mode", mode}}));
  }
  std::string warned;
  scene::warning_listener() = [&](const std::string& warning) { warned += warning; };
  EXPECT_EQ(read(made.text()).mesh.triangles.size(), 1U);
  scene::warning_listener() = {};
  EXPECT_THAT(warned, HasSubstr("4 primitives of points or lines"));
}

TEST(Gltf, PutsSparseValuesIn) {
  for (const bool base : {true, false}) {
    MadeGltf made;
    json accessor = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
    if (base) accessor["bufferView"] = made.add_view(floats({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", made.add_view(numbers({0, 2}, 5121))}, {"componentType", 5121}}},
                          {"values", {{"bufferView", made.add_view(floats({7, 8, 9, 4, 5, 6}))}}}};
    made.add_node(made.add_mesh({{"attributes", {{"POSITION", made.add("accessors", accessor)}}}}));
    const Point middle = base ? Point{1, 0, 0} : Point{0, 0, 0};
    EXPECT_THAT(read(made.text()).mesh.points, ElementsAre(Point{7, 8, 9}, middle, Point{4, 5, 6}));
  }
}

TEST(Gltf, ReadsInterleavedPositions) {
  MadeGltf made;
  const auto view = made.add_view(floats({-1, 0, 0, 0, -1, 1, 0, 0, -1, 0, 1, 0}), 16);
  made.add_node(made.add_mesh(
      {{"attributes",
        {{"POSITION",
          made.add(
              "accessors",
              {{"bufferView", view}, {"byteOffset", 4}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}})}}}}));
  EXPECT_THAT(read(made.text()).mesh.points, ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}));
}

TEST(Gltf, MultipliesTransformsInDoubles) {
  auto made = one_triangle();
  made.json["nodes"] = {{{"children", {1, 2}}, {"translation", {0.1, 0, 0}}},
                        {{"mesh", 0},
                         {"scale", {2, 4, 8}},
                         {"translation", {0.2, 0, 0}},
                         {"rotation", {0, 0, 0.7071067811865476, 0.7071067811865476}}},
                        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}}};
  const auto mesh = read(made.text());
  ASSERT_EQ(mesh.mesh.points.size(), 6U);
  EXPECT_EQ(mesh.mesh.points[0], (Point{0.1 + 0.2, 0, 0})) << "and not the nearest float";
  EXPECT_NEAR(mesh.mesh.points[1][1], 2, 1e-15);
  EXPECT_NEAR(mesh.mesh.points[2][0], 0.3 - 4, 1e-15);
  EXPECT_EQ(mesh.mesh.points[3], (Point{10.1, 20, 30}));
  EXPECT_EQ(mesh.name_of(0), "node 1 / mesh 0 / primitive 0");
  EXPECT_EQ(mesh.name_of(1), "node 2 / mesh 0 / primitive 0");
}

TEST(Gltf, TurnsTrianglesThatAreMirrored) {
  auto made = one_triangle();
  made.json["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  EXPECT_THAT(corners_of(read(made.text())), ElementsAre(ElementsAre(Point{0, 0, 0}, Point{0, 1, 0}, Point{-1, 0, 0})));
}

// In doubles the determinants are 0, or no numbers.
TEST(Gltf, TurnsTrianglesThatAreMirroredAndVerySmallOrLarge) {
  for (const double size : {1e-120, 1e120}) {
    SCOPED_TRACE(size);
    auto made = one_triangle();
    made.json["nodes"] = {{{"mesh", 0}, {"scale", {-size, size, size}}}};
    EXPECT_THAT(corners_of(read(made.text())),
                ElementsAre(ElementsAre(Point{0, 0, 0}, Point{0, size, 0}, Point{-size, 0, 0})));
    made.json["nodes"] = {{{"mesh", 0}, {"scale", {size, size, size}}}};
    EXPECT_THAT(corners_of(read(made.text())),
                ElementsAre(ElementsAre(Point{0, 0, 0}, Point{size, 0, 0}, Point{0, size, 0})));
  }
}

TEST(Gltf, ReadsTheDefaultScene) {
  auto made = one_triangle();
  made.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}, {"name", "far"}}};
  made.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  EXPECT_EQ(read(made.text()).mesh.points[0], (Point{0, 0, 0}));
  made.json["scene"] = 1;
  const auto mesh = read(made.text());
  EXPECT_EQ(mesh.mesh.points.size(), 3U);
  EXPECT_EQ(mesh.mesh.points[0], (Point{5, 0, 0}));
  EXPECT_EQ(mesh.name_of(0), "node 1 (far) / mesh 0 / primitive 0");
}

TEST(Gltf, LetsLightThroughWhatIsNotKnownToBeOpaque) {
  const auto blocks = [](const json& material, const json& more = json::object()) {
    auto made = one_triangle();
    made.add("materials", material);
    made.json["meshes"][0]["primitives"][0]["material"] = 0;
    made.json.update(more, true);
    const auto mesh = read(made.text());
    EXPECT_TRUE(mesh.counting(0));
    return mesh.blocking(0);
  };
  EXPECT_TRUE(blocks(json::object()));
  EXPECT_TRUE(blocks({{"alphaMode", "OPAQUE"}, {"doubleSided", true}}));
  EXPECT_FALSE(blocks({{"alphaMode", "MASK"}}));
  EXPECT_FALSE(blocks({{"alphaMode", "BLEND"}}));
  EXPECT_FALSE(blocks({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}}));
  const json animation = {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}};
  EXPECT_FALSE(blocks(json::object(), {{"animations", json::array({animation})}}));
  auto morphing = one_triangle();
  morphing.json["meshes"][0]["primitives"][0]["targets"] = json::array({json::object()});
  EXPECT_FALSE(read(morphing.text()).blocking(0));
  auto skinned = one_triangle();
  skinned.json["nodes"][0]["skin"] = 0;
  EXPECT_FALSE(read(skinned.text()).blocking(0));
}

// What an extension switches off, exchanges or animates is not known to be there either. All of these once blocked.
TEST(Gltf, LetsLightThroughWhatExtensionsMayTakeAway) {
  const auto blocks = [](const json& more) {
    auto made = one_triangle();
    made.json["materials"] = {json::object(), {{"alphaMode", "BLEND"}}};
    made.json["meshes"][0]["primitives"][0]["material"] = 0;
    made.json.merge_patch(more);
    const auto mesh = read(made.text());
    EXPECT_TRUE(mesh.counting(0));
    return mesh.blocking(0);
  };
  const auto node = [&](const json& extensions) {
    auto made = one_triangle();
    made.json["nodes"][0]["extensions"] = extensions;
    return blocks({{"nodes", made.json["nodes"]}});
  };
  EXPECT_TRUE(node({{"KHR_node_visibility", {{"visible", true}}}}));
  EXPECT_FALSE(node({{"KHR_node_visibility", {{"visible", false}}}}));
  EXPECT_FALSE(node({{"MSFT_lod", {{"ids", {1}}}}}));

  const auto variants = [&](std::size_t material) {
    auto made = one_triangle();
    json& primitive = made.json["meshes"][0]["primitives"][0];
    primitive["extensions"] = {
        {"KHR_materials_variants", {{"mappings", {{{"material", material}, {"variants", {0}}}}}}}};
    return blocks({{"meshes", made.json["meshes"]}});
  };
  EXPECT_TRUE(variants(0));
  EXPECT_FALSE(variants(1));

  const auto material = [&](const char* extension) {
    return blocks({{"materials", {{{"extensions", {{extension, json::object()}}}}}}});
  };
  EXPECT_TRUE(material("KHR_materials_unlit"));
  EXPECT_FALSE(material("ADOBE_materials_thin_transparency"));

  const auto animated = [&](const char* pointer) {
    const json target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    return blocks({{"animations", {{{"channels", {{{"sampler", 0}, {"target", target}}}}}}}});
  };
  EXPECT_TRUE(animated("/cameras/0/perspective/yfov"));
  EXPECT_FALSE(animated("/nodes/0/translation"));
  EXPECT_FALSE(animated("/nodes/0/extensions/KHR_node_visibility/visible"));
  EXPECT_FALSE(animated("/materials/0/pbrMetallicRoughness/baseColorFactor"));
  EXPECT_THROW(animated("/nodes/1/translation"), scene::Error);
  EXPECT_THROW(animated("/materials/x/alphaCutoff"), scene::Error);
}

TEST(Gltf, IsReadFromFilesByTheirNames) {
  const SceneFolder folder;
  auto made = with_primitive(4, true, 5125);
  made.add("materials", {{"alphaMode", "BLEND"}});
  const auto plain = read(made.text()).mesh.points;
  EXPECT_EQ(scene::read_scene(folder.write("a.gltf", made.text())).mesh.points, plain);
  EXPECT_EQ(scene::read_plain_scene(folder.write("a.GLB", made.glb())).points, plain);
  folder.write("a b.bin", made.buffer);
  made.json["buffers"] = {{{"byteLength", made.buffer.size()}, {"uri", "a%20b.bin"}}};
  EXPECT_EQ(scene::read_scene(folder.write("b.gltf", made.json.dump())).mesh.points, plain);
  made.json["meshes"][0]["primitives"][0]["material"] = 0;
  const auto glass = folder.write("glass.gltf", made.json.dump());
  EXPECT_FALSE(scene::read_scene(glass).is_plain());
  EXPECT_THAT(thrown_by([&] { scene::read_plain_scene(glass); }).text,
              HasSubstr("2 triangles do not block and 0 do not count"));
}

// Another writer: what tinygltf puts down is read as it was meant.
TEST(Gltf, IsReadAsTinygltfWritesIt) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.buffers.resize(1);
  const std::string bytes = floats({0, 0, 0, 1.5, 0, 0, 0, 0.1, 0}) + numbers({0, 1, 2, 2, 1, 0}, 5123);
  model.buffers[0].data.assign(bytes.begin(), bytes.end());
  model.bufferViews.resize(2);
  model.bufferViews[0].buffer = model.bufferViews[1].buffer = 0;
  model.bufferViews[0].byteLength = model.bufferViews[1].byteOffset = 36;
  model.bufferViews[1].byteLength = 12;
  model.accessors.resize(2);
  for (int i = 0; i < 2; ++i) {
    auto& accessor = model.accessors[static_cast<std::size_t>(i)];
    accessor.bufferView = i;
    accessor.componentType = i == 0 ? TINYGLTF_COMPONENT_TYPE_FLOAT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.type = i == 0 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_SCALAR;
    accessor.count = i == 0 ? 3 : 6;
  }
  model.materials.resize(1);
  model.materials[0].alphaMode = "MASK";
  model.meshes.resize(1);
  model.meshes[0].primitives.resize(2);
  for (auto& primitive : model.meshes[0].primitives) {
    primitive.attributes["POSITION"] = 0;
    primitive.indices = 1;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
  }
  model.meshes[0].primitives[1].material = 0;
  model.nodes.resize(2);
  model.nodes[0].mesh = 0;
  model.nodes[0].translation = {1, 2, 3};
  model.nodes[1].children = {0};
  model.nodes[1].matrix = {0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};  // mirrors
  model.scenes.resize(1);
  model.scenes[0].nodes = {1};
  model.defaultScene = 0;
  for (const bool binary : {false, true}) {
    std::ostringstream out;
    ASSERT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, true, binary));
    const auto mesh = read(out.str());
    ASSERT_EQ(mesh.mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.blocks, (std::vector<std::uint8_t>{1, 1, 0, 0}));
    EXPECT_THAT(corners_of(mesh)[0], ElementsAre(Point{4, 2, 6}, Point{2.0 * (2.0 + 0.1F), 2, 6}, Point{4, 5, 6}));
  }
}

TEST(GltfLong, OfAMillionTrianglesTakesTwoSecondsAtMost) {
  MadeGltf made;
  constexpr std::uint32_t side = 708;
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x)
      points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(x * y % 7)});
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x;
      for (const std::uint32_t i : {a, a + 1, a + side + 1, a + 1, a + side + 2, a + side + 1}) indices.push_back(i);
    }
  }
  made.add_node(made.add_mesh(
      {{"attributes", {{"POSITION", made.add_positions(points)}}}, {"indices", made.add_indices(indices)}}));
  const SceneFolder folder;
  const auto path = folder.write("million.glb", made.glb());
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(scene::read_scene(path).mesh.triangles.size(), 2U * side * side);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

}  // namespace
}  // namespace clues::tests
