// What is not a scene is refused with a code, the file, the place and one line of text; never repaired.
#include <gmock/gmock.h>

#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::ErrorCode;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct BadScene {
  const char* name;  // of the test
  const char* file;
  std::string bytes;
  ErrorCode code;
  std::string place;  // what follows the file's name
  const char* mentions;
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedAtItsPlace) {
  const SceneFolder folder;
  const auto path = folder.write(GetParam().file, GetParam().bytes);
  const auto thrown = thrown_by([&] { scene::read_mesh(path); });
  EXPECT_EQ(thrown.code, GetParam().code) << thrown.text;
  EXPECT_THAT(thrown.text,
              AllOf(HasSubstr(path + GetParam().place), HasSubstr(GetParam().mentions), Not(HasSubstr("\n"))));
}

std::string name_of(const testing::TestParamInfo<BadScene>& test) { return test.param.name; }

constexpr auto malformed = ErrorCode::malformed;
constexpr auto unsupported = ErrorCode::unsupported;
constexpr auto non_finite = ErrorCode::non_finite;
constexpr auto out_of_range = ErrorCode::index_out_of_range;

const std::string three_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Obj, BadSceneTest,
    testing::Values(
        BadScene{"Empty", "a.obj", "", malformed, "", "empty"},
        BadScene{"NoTriangles", "a.obj", three_points, malformed, "", "no triangles"},
        BadScene{"Nan", "a.obj", "v 0 0 0\nv nan 0 0\n", non_finite, ":2", "'nan'"},
        BadScene{"Infinity", "a.obj", "v 0 -inf 0\n", non_finite, ":1", "'-inf'"},
        BadScene{"Overflow", "a.obj", "# c\n\nv 0 0 1e999\n", non_finite, ":3", "1e999"},
        BadScene{"Word", "a.obj", "v 0 x 0\n", malformed, ":1", "'x'"},
        BadScene{"TwoCoordinates", "a.obj", "v 0 0\n", malformed, ":1", "2"},
        BadScene{"ColourIsAWord", "a.obj", "v 0 0 0 red\n", malformed, ":1", "'red'"},
        BadScene{"NothingButAnEdge", "a.obj", three_points + "f 1 2\n", malformed, "", "no triangles"},
        BadScene{"NoCorners", "a.obj", three_points + "f\n", malformed, ":4", "0 corners"},
        BadScene{"IndexZero", "a.obj", three_points + "f 0 1 2\n", out_of_range, ":4", "0"},
        BadScene{"IndexTooLarge", "a.obj", three_points + "f 1 2 3\nf 1 2 4\nf 1 2 3\n", out_of_range, ":5",
                 "vertex 4, but the vertices are 1 to 3"},
        BadScene{"IndexBeyond32Bits", "a.obj", three_points + "f 1 2 4294967297\n", out_of_range, ":4", "4294967297"},
        BadScene{"IndexTooNegative", "a.obj", three_points + "f -1 -2 -4\n", out_of_range, ":4", "-4"},
        BadScene{"NoVertices", "a.obj", "f 1 2 3\n", out_of_range, ":1", "no vertex"},
        BadScene{"CornerIsAWord", "a.obj", three_points + "f 1 2 three\n", malformed, ":4", "three"},
        BadScene{"CornerIsDecimal", "a.obj", three_points + "f 1 2 3.0\n", malformed, ":4", "3.0"},
        BadScene{"CornerIsASlash", "a.obj", three_points + "f 1 2 /\n", malformed, ":4", "'/'"},
        BadScene{"CornerWithThreeSlashes", "a.obj", three_points + "f 1 2 3///\n", malformed, ":4", "3///"},
        BadScene{"CornerWithFourParts", "a.obj", three_points + "f 1/1/1/1 2 3\n", malformed, ":4", "1/1/1/1"},
        BadScene{"FreeFormSurface", "a.obj", three_points + "cstype bezier\n", unsupported, ":4", "polygons"},
        BadScene{"UnknownKeyword", "a.obj", "vertex 1 2 3\n", malformed, ":1", "vertex"},
        BadScene{"UnprintableBytes", "a.obj", std::string("v\0\x01\n", 4), malformed, ":1", "v??"},
        BadScene{"LineNumberAfterContinuation", "a.obj", "v 0 \\\n0 \\\n0\nv 1 1 y\n", malformed, ":4", "y"},
        BadScene{"UnknownExtension", "a.xyz", "0 0 0\n", unsupported, "", ".obj"},
        BadScene{"NoExtension", "scene", "OFF\n", unsupported, "", ".obj"}),
    name_of);

const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Off, BadSceneTest,
    testing::Values(BadScene{"Empty", "a.off", "", malformed, "", "empty"},
                    BadScene{"OnlyComments", "a.off", "# nothing\n", malformed, "", "OFF"},
                    BadScene{"NoKeyword", "a.off", "three 1 0\n", malformed, ":1", "OFF"},
                    BadScene{"FourDimensions", "a.off", "4OFF\n3 1 0\n", unsupported, ":1", "4OFF"},
                    BadScene{"BinaryWithoutCounts", "a.off", "OFF BINARY\n", malformed, ": header 0", "truncated"},
                    BadScene{"BinaryFourDimensions", "a.off", "4OFF BINARY\n", unsupported, ":1", "4OFF"},
                    BadScene{"BinaryWithTheLowByteFirst", "a.off",
                             std::string("OFF BINARY\n\3\0\0\0\1\0\0\0\0\0\0\0", 23), malformed, ": header 0",
                             "low bytes"},
                    BadScene{"FreeLayoutWithANumberTooMany", "a.off", "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2 7",
                             malformed, ":1", "counts"},
                    BadScene{"FreeLayoutWithANumberMissing", "a.off", "OFF\n3 1 0\n0 0 0 1 0 0 0 1\n3 0 1 2\n",
                             malformed, ":5", "vertex 2 of 3"},
                    BadScene{"NegativeCount", "a.off", "OFF\n-3 1 0\n", malformed, ":2", "counts"},
                    BadScene{"NoTriangles", "a.off", "OFF\n1 0 0\n0 0 0\n", malformed, "", "no triangles"},
                    BadScene{"FewerVertices", "a.off", "OFF\n3 1 0\n0 0 0\n", malformed, "", "vertex 1 of 3"},
                    BadScene{"FewerFaces", "a.off", off, malformed, "", "face 0 of 1"},
                    BadScene{"MoreLines", "a.off", off + "3 0 1 2\n3 0 1 2\n", malformed, ":7", "counts"},
                    BadScene{"NothingButAnEdge", "a.off", off + "2 0 1\n", malformed, "", "no triangles"},
                    BadScene{"MissingCorner", "a.off", off + "3 0 1\n", malformed, ":6", "3 corners"},
                    BadScene{"Index", "a.off", off + "3 0 1 3\n", out_of_range, ":6", "vertex 3"},
                    BadScene{"NegativeIndex", "a.off", off + "3 0 1 -1\n", out_of_range, ":6", "-1"},
                    BadScene{"Nan", "a.off", "OFF\n1 0 0\n0 0 NaN\n", non_finite, ":3", "NaN"}),
    name_of);

const std::string ply_vertices =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
const std::string ply = ply_vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_points = "0 0 0\n1 0 0\n0 1 0\n";

// One triangle whose second vertex has that x, and whose last corner is that.
std::string binary_ply(std::endian order, double x, std::int32_t corner, std::uint8_t corners = 3) {
  auto bytes = ply;
  bytes.replace(bytes.find("ascii"), 5, order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const double coordinate : {0., 0., 0., x, 0., 0., 0., 1., 0.}) append(bytes, coordinate, order);
  append(bytes, corners, order);
  append(bytes, std::int32_t{0}, order);
  if (corners > 2) append(bytes, std::int32_t{1}, order);
  append(bytes, corner, order);
  return bytes;
}

std::string without_end(std::string bytes, std::size_t n) { return bytes.substr(0, bytes.size() - n); }

const double nan_value = std::bit_cast<double>(0x7ff8000000000000u);
const double infinity = std::bit_cast<double>(0x7ff0000000000000u);

INSTANTIATE_TEST_SUITE_P(
    Ply, BadSceneTest,
    testing::Values(
        BadScene{"Empty", "a.ply", "", malformed, "", "empty"},
        BadScene{"NoMagic", "a.ply", "plx\n", malformed, "", "ply"},
        BadScene{"NoFormat", "a.ply", "ply\nend_header\n", malformed, ":2", "format"},
        BadScene{"OtherVersion", "a.ply", "ply\nformat ascii 2.0\n", unsupported, ":2", "2.0"},
        BadScene{"OtherFormat", "a.ply", "ply\nformat binary 1.0\n", unsupported, ":2", "binary"},
        BadScene{"CutHeader", "a.ply", ply_vertices, malformed, ":7", "end_header"},
        BadScene{"UnknownType", "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", unsupported,
                 ":4", "real"},
        BadScene{"NoZ", "a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
                 malformed, "", " z"},
        BadScene{"NoVertexElement", "a.ply", "ply\nformat ascii 1.0\nend_header\n", malformed, "", "vertex"},
        BadScene{"NoIndexList", "a.ply", ply_vertices + "element face 1\nproperty int flag\nend_header\n", malformed,
                 "", "vertex_indices"},
        BadScene{"FloatIndices", "a.ply",
                 ply_vertices + "element face 1\nproperty list uchar float vertex_indices\nend_header\n", malformed, "",
                 "whole numbers"},
        BadScene{"StripsOfFloats", "a.ply",
                 ply_vertices + "element tristrips 1\nproperty list int float vertex_indices\nend_header\n", malformed,
                 "", "whole numbers"},
        BadScene{"StripWithAnotherNegativeIndex", "a.ply",
                 ply_vertices + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + ply_points +
                     "4 0 1 2 -2\n",
                 out_of_range, ":13", "vertex -2"},
        BadScene{"HugeCountWithoutProperty", "a.ply", ply_vertices + "element rest 9000000000000000000\nend_header\n",
                 malformed, ":8", "rest"},
        BadScene{"Nan", "a.ply", ply + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", non_finite, ":11", "nan"},
        BadScene{"ShortLine", "a.ply", ply + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n", malformed, ":10", "fewer"},
        BadScene{"LongLine", "a.ply", ply + "0 0 0 0\n", malformed, ":10", "more"},
        BadScene{"NoFace", "a.ply", ply + ply_points, malformed, ":13", "face 0"},
        BadScene{"MoreFaces", "a.ply", ply + ply_points + "3 0 1 2\n3 0 1 2\n", malformed, ":14", "more lines"},
        BadScene{"NothingButAnEdge", "a.ply", ply + ply_points + "2 0 1\n", malformed, "", "no triangles"},
        BadScene{"ShortList", "a.ply", ply + ply_points + "4 0 1 2\n", malformed, ":13", "4 entries"},
        BadScene{"NegativeList", "a.ply", ply + ply_points + "-1\n", malformed, ":13", "-1"},
        BadScene{"Index", "a.ply", ply + ply_points + "3 0 1 3\n", out_of_range, ":13", "vertex 3"},
        BadScene{"BinaryNan", "a.ply", binary_ply(std::endian::little, nan_value, 2), non_finite, ": vertex 1", " x "},
        BadScene{"BinaryInfinity", "a.ply", binary_ply(std::endian::big, infinity, 2), non_finite, ": vertex 1", " x "},
        BadScene{"BinaryIndex", "a.ply", binary_ply(std::endian::little, 1, 3), out_of_range, ": face 0", "vertex 3"},
        BadScene{"BinaryNegativeIndex", "a.ply", binary_ply(std::endian::big, 1, -1), out_of_range, ": face 0", "-1"},
        BadScene{"BinaryCutInFace", "a.ply", without_end(binary_ply(std::endian::little, 1, 2), 1), malformed,
                 ": face 0", "truncated"},
        BadScene{"BinaryCutInVertex", "a.ply", without_end(binary_ply(std::endian::big, 1, 2), 14), malformed,
                 ": vertex 2", "truncated"}),
    name_of);

const std::string stl_start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";

std::string binary_stl_with(float x) {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{1}, std::endian::little);
  for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, x, 0.F, 0.F, 0.F, 1.F, 0.F}) {
    append(bytes, value, std::endian::little);
  }
  return bytes + std::string(2, '\0');
}

INSTANTIATE_TEST_SUITE_P(
    Stl, BadSceneTest,
    testing::Values(
        BadScene{"Empty", "a.stl", "", malformed, "", "empty"},
        BadScene{"NoTriangles", "a.stl", "solid\nendsolid\n", malformed, "", "no triangles"},
        BadScene{"NotStl", "a.stl", "hello", malformed, "", "neither"},
        BadScene{"BinaryCut", "a.stl", without_end(binary_stl_with(1), 1), malformed, "", "134"},
        BadScene{"BytesAfterNoTriangle", "a.stl", std::string(84, '\0') + "x", malformed, "", "85"},
        BadScene{"WordsAfterTheEnd", "a.stl", "solid\nendsolid\nmore\n", malformed, ":3", "'more'"},
        BadScene{"BinaryNan", "a.stl", binary_stl_with(static_cast<float>(nan_value)), non_finite, ": face 0", " x "},
        BadScene{"AsciiCut", "a.stl", stl_start, malformed, ":6", "truncated"},
        BadScene{"NoEndsolid", "a.stl", stl_start + "vertex 0 1 0\nendloop\nendfacet\n", malformed, ":9", "endsolid"},
        BadScene{"TwoCorners", "a.stl", stl_start + "endloop\nendfacet\nendsolid\n", malformed, ":2", "2 corners"},
        BadScene{"Nan", "a.stl", stl_start + "vertex 0 nan 0\n", non_finite, ":6", "nan"},
        BadScene{"WrongWord", "a.stl", stl_start + "normal 0 1 0\n", malformed, ":6", "'normal'"}),
    name_of);

TEST(BadFile, Missing) {
  const SceneFolder folder;
  const auto thrown = thrown_by([&] { scene::read_mesh(folder.file("nothing.obj")); });
  EXPECT_EQ(thrown.code, ErrorCode::file_not_found);
  EXPECT_THAT(thrown.text, HasSubstr(folder.file("nothing.obj")));
}

TEST(BadFile, Folder) {
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.obj");
  EXPECT_EQ(thrown_by([&] { scene::read_mesh(folder.file("folder.obj")); }).code, ErrorCode::file_unreadable);
}

}  // namespace
}  // namespace clues::tests
