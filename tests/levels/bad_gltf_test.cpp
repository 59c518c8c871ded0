// What is no glTF scene is refused, with the place and one line.
#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "scene/gltf/gltf_reader.h"
#include "tests/levels/made_gltf.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using nlohmann::json;
using scene::ErrorCode;
using testing::HasSubstr;

std::string no_file(const std::string& path) {
  throw scene::Error(ErrorCode::file_not_found, path + ": there is none");
}

struct BadGltf {
  const char* name;
  std::function<void(MadeGltf&)> spoil;
  ErrorCode code;
  const char* mentions;
};
void PrintTo(const BadGltf& bad, std::ostream* out) { *out << bad.name; }

class BadGltfTest : public testing::TestWithParam<BadGltf> {};

TEST_P(BadGltfTest, IsRefused) {
  auto made = one_triangle();
  made.json["meshes"][0]["primitives"][0]["indices"] = made.add_indices({0, 1, 2}, 5121);
  GetParam().spoil(made);
  const auto thrown = thrown_by([&] { scene::read_gltf(made.text(), "made.gltf", no_file); });
  EXPECT_EQ(thrown.code, GetParam().code) << thrown.text;
  EXPECT_THAT(thrown.text, HasSubstr(GetParam().mentions));
  EXPECT_THAT(thrown.text, testing::StartsWith("made.gltf"));
}

constexpr auto malformed = ErrorCode::malformed;
constexpr auto unsupported = ErrorCode::unsupported;
constexpr auto out_of_range = ErrorCode::index_out_of_range;

json& primitive(MadeGltf& made) { return made.json["meshes"][0]["primitives"][0]; }

INSTANTIATE_TEST_SUITE_P(
    All, BadGltfTest,
    testing::Values(
        BadGltf{"NoAsset", [](MadeGltf& m) { m.json.erase("asset"); }, malformed, "no \"asset\""},
        BadGltf{"VersionOne", [](MadeGltf& m) { m.json["asset"]["version"] = "1.0"; }, unsupported, "1.0"},
        BadGltf{"Draco", [](MadeGltf& m) { m.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
                unsupported, "KHR_draco_mesh_compression"},
        BadGltf{"Quantized", [](MadeGltf& m) { m.json["extensionsRequired"] = {"KHR_mesh_quantization"}; }, unsupported,
                "KHR_mesh_quantization"},
        BadGltf{"GpuInstances",
                [](MadeGltf& m) { m.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object(); },
                unsupported, "EXT_mesh_gpu_instancing"},
        BadGltf{"Cycle",
                [](MadeGltf& m) {
                  m.json["nodes"][0]["children"] = {0};
                  m.json["scenes"] = {{{"nodes", {0}}}};
                },
                malformed, "node 0: is reached twice"},
        BadGltf{"TwoParents",
                [](MadeGltf& m) {
                  m.json["nodes"].push_back({{"children", {0, 0}}});
                },
                malformed, "node 0: is reached twice"},
        BadGltf{"MeshOfNode", [](MadeGltf& m) { m.json["nodes"][0]["mesh"] = 1; }, out_of_range, "node 0: mesh 1"},
        BadGltf{"MeshIsText", [](MadeGltf& m) { m.json["nodes"][0]["mesh"] = "0"; }, malformed, "node 0: \"mesh\""},
        BadGltf{"MeshIsBelowZero", [](MadeGltf& m) { m.json["nodes"][0]["mesh"] = -1; }, malformed, "node 0: \"mesh\""},
        BadGltf{"ChildOfNode", [](MadeGltf& m) { m.json["nodes"][0]["children"] = {7}; }, out_of_range, "node 7"},
        BadGltf{"SceneOfFile", [](MadeGltf& m) { m.json["scene"] = 0; }, out_of_range, "scene 0"},
        BadGltf{"MatrixAndScale",
                [](MadeGltf& m) {
                  m.json["nodes"][0].update(
                      {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
                },
                malformed, "a matrix, and"},
        BadGltf{"Projective",
                [](MadeGltf& m) { m.json["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
                malformed, "last row"},
        BadGltf{"ShortMatrix",
                [](MadeGltf& m) {
                  m.json["nodes"][0]["matrix"] = {1, 0, 0};
                },
                malformed, "16 numbers"},
        BadGltf{"NoUnitQuaternion",
                [](MadeGltf& m) {
                  m.json["nodes"][0]["rotation"] = {0, 0, 0, 2};
                },
                malformed, "quaternion"},
        BadGltf{"FarAway",
                [](MadeGltf& m) {
                  m.json["nodes"][0].update({{"scale", {1e308, 1, 1}}, {"translation", {1.5e308, 0, 0}}});
                },
                ErrorCode::non_finite, "no finite place"},
        BadGltf{"NoAttributes", [](MadeGltf& m) { primitive(m).erase("attributes"); }, malformed, "no \"attributes\""},
        BadGltf{"PositionAccessor", [](MadeGltf& m) { primitive(m)["attributes"]["POSITION"] = 5; }, out_of_range,
                "accessor 5"},
        BadGltf{"ModeSeven", [](MadeGltf& m) { primitive(m)["mode"] = 7; }, malformed, "\"mode\""},
        BadGltf{"AlphaMode",
                [](MadeGltf& m) {
                  primitive(m)["material"] = m.add("materials", {{"alphaMode", "GLASS"}});
                },
                malformed, "alphaMode"},
        BadGltf{"Material", [](MadeGltf& m) { primitive(m)["material"] = 0; }, out_of_range, "material 0"},
        BadGltf{"IndexPastTheEnd",
                [](MadeGltf& m) {
                  primitive(m)["indices"] = m.add_indices({0, 1, 3});
                },
                out_of_range, "vertex 3"},
        BadGltf{"TwoCorners",
                [](MadeGltf& m) {
                  primitive(m)["indices"] = m.add_indices({0, 1});
                },
                malformed, "no multiple of 3"},
        BadGltf{"FloatIndices", [](MadeGltf& m) { m.json["accessors"][1]["componentType"] = 5126; }, malformed,
                "component type is 5126"},
        BadGltf{"ShortPositions", [](MadeGltf& m) { m.json["accessors"][0]["componentType"] = 5122; }, unsupported,
                "quantized"},
        BadGltf{"Vec2", [](MadeGltf& m) { m.json["accessors"][0]["type"] = "VEC2"; }, malformed, "no VEC3"},
        BadGltf{"TooMany", [](MadeGltf& m) { m.json["accessors"][0]["count"] = 4; }, malformed, "do not fit"},
        BadGltf{"TooManyZeros",
                [](MadeGltf& m) {
                  m.json["accessors"][0].erase("bufferView");
                  m.json["accessors"][0]["count"] = 4000000000U;
                },
                unsupported, "more than"},
        BadGltf{"OffsetPastTheEnd", [](MadeGltf& m) { m.json["accessors"][0]["byteOffset"] = 4; }, malformed,
                "do not fit"},
        BadGltf{"ViewPastTheEnd", [](MadeGltf& m) { m.json["bufferViews"][0]["byteOffset"] = 4000; }, malformed,
                "are not in buffer 0"},
        BadGltf{"ViewOfBuffer", [](MadeGltf& m) { m.json["bufferViews"][0]["buffer"] = 1; }, out_of_range, "buffer 1"},
        BadGltf{"NarrowStride", [](MadeGltf& m) { m.json["bufferViews"][0]["byteStride"] = 8; }, malformed,
                "stride of 8"},
        BadGltf{"NanPosition",
                [](MadeGltf& m) { m.buffer.replace(0, 4, floats({std::numeric_limits<double>::quiet_NaN()})); },
                ErrorCode::non_finite, "accessor 0: element 0"},
        BadGltf{"SparsePastTheEnd",
                [](MadeGltf& m) {
                  m.json["accessors"][0]["sparse"] = {
                      {"count", 1},
                      {"indices", {{"bufferView", m.add_view(numbers({3}, 5121))}, {"componentType", 5121}}},
                      {"values", {{"bufferView", m.add_view(floats({1, 1, 1}))}}}};
                },
                malformed, "sparse value 0 is for element 3"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Gltf, WithBuffersElsewhereIsRefused) {
  auto made = one_triangle();
  for (const char* uri :
       {"/etc/passwd", "../a.bin", "a/../../b.bin", "https://example.org/a.bin", "%2Fetc%2Fpasswd", "", "a%0.bin"}) {
    made.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    EXPECT_THAT(thrown_by([&] { scene::read_gltf(made.json.dump(), "x", no_file); }).text,
                HasSubstr("in the folder of the document"))
        << uri;
  }
  made.json["buffers"] = {{{"byteLength", 36}, {"uri", "data:text/plain,abc"}}};
  EXPECT_THAT(thrown_by([&] { scene::read_gltf(made.json.dump(), "x", no_file); }).text, HasSubstr(";base64,"));
  made.json["buffers"] = {{{"byteLength", 36}, {"uri", "data:;base64,AB!="}}};
  EXPECT_THAT(thrown_by([&] { scene::read_gltf(made.json.dump(), "x", no_file); }).text, HasSubstr("no base64"));
  made.json["buffers"] = {{{"byteLength", 36}}};
  EXPECT_THAT(thrown_by([&] { scene::read_gltf(made.json.dump(), "x", no_file); }).text, HasSubstr("no \"uri\""));
}

// Cut anywhere, a .glb file is refused.
TEST(Gltf, CutShortIsRefused) {
  const std::string bytes = one_triangle().glb();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    try {
      scene::read_gltf(bytes.substr(0, size), "x", no_file);
      FAIL() << size;
    } catch (const scene::Error& error) {
      ASSERT_NE(error.code(), ErrorCode::internal) << size << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace clues::tests
