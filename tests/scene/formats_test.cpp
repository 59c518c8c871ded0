// D1: what each format may write, and that triangle i is the i-th triangle of the file.
#include <gmock/gmock.h>

#include "scene/formats/readers.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::Point;
using scene::Triangle;
using testing::ElementsAre;

const std::string unit = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Fan, FromTheFirstCornerWithTheFaceNumber) {
  const auto mesh = mesh_of("a.obj", unit + "v 2 2 2\nf 1 2 3\nf 3 1 2 4 5\nf 4 3 2\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 0, 1}, Triangle{2, 1, 3}, Triangle{2, 3, 4},
                                          Triangle{3, 2, 1}));
  EXPECT_THAT(mesh.face_of, ElementsAre(0, 1, 1, 1, 2));
}

TEST(Fan, IsTheSameInEveryFormat) {
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto ply = mesh_of("a.ply",
                           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
                           "float z\nelement face 1\nproperty list uchar uint vertex_index\nend_header\n" +
                               points + "4 3 2 1 0\n");
  const auto off = mesh_of("a.off", "OFF\n4 1 0\n" + points + "4 3 2 1 0\n");
  const auto obj = mesh_of("a.obj", unit + "f 4 3 2 1\n");
  for (const auto& mesh : {ply, off, obj}) {
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{3, 2, 1}, Triangle{3, 1, 0}));
    EXPECT_THAT(mesh.face_of, ElementsAre(0, 0));
  }
  const auto stl =
      mesh_of("a.stl",
              "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 1 0\nvertex 1 1 0\nvertex 1 0 0\nvertex 0 "
              "0 0\nendloop\nendfacet\nendsolid s\n");
  EXPECT_THAT(stl.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Obj, CornerForms) {
  const auto mesh =
      mesh_of("a.obj", unit + "vt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 -1/-1/-1\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}, Triangle{0, 1, 3}));
}

TEST(Obj, NegativeIndicesCountBackFromTheLine) {
  const auto mesh = mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -2 -1\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Obj, AVertexMayComeAfterItsFace) {
  EXPECT_THAT(mesh_of("a.obj", "f 1 2 3\n" + unit).triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, WhatIsNoSurfaceIsLeftOut) {
  const auto mesh = mesh_of("a.obj", "# comment \\\nmtllib a.mtl\no thing\ng part\ns off\nusemtl red\nvp 0 0\n" + unit +
                                         "l 1 2 3\np 1\nf 1 2 3 # a comment\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, ColoursWeightsContinuedLinesAndLineEnds) {
  const auto mesh =
      mesh_of("a.obj", "\xEF\xBB\xBFv 0 0 0 0.5 0.25 1\r\nv 1 0 0 1\r\nv\t0 \\\r\n 1 0\r\n\r\nf 1 \\\n2 \\\n3");
  EXPECT_THAT(mesh.points, ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Obj, UnusedAndRepeatedVerticesAreKept) {
  const auto mesh = mesh_of("a.obj", unit + unit + "f 1 2 3\n");
  EXPECT_EQ(mesh.points.size(), 8u);
}

TEST(Off, Headers) {
  const std::string rest = "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n";
  for (const std::string head : {"OFF\n3 1 0\n", "OFF 3 1 0\n", "COFF\n3 1 0\n", "NOFF\n3 1\n", "STCNOFF\n\n3 1 0\n",
                                 "# first\nOFF # second\n# third\n3 1 3 # fourth\n"}) {
    EXPECT_THAT(mesh_of("a.off", head + rest).triangles, ElementsAre(Triangle{0, 1, 2})) << head;
  }
}

TEST(Off, ColoursAfterFaces) {
  const auto mesh =
      mesh_of("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0 0\n3 0 1 3 0.5 0.5 0.5 1\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 3}));
}

TEST(Extension, CaseDoesNotCount) { EXPECT_EQ(mesh_of("A.OBJ", unit + "f 1 2 3\n").triangles.size(), 1u); }

// Every type, lists among the scalars, elements before, between and after, faces before vertices.
std::string wild_ply(std::endian order) {
  const bool little = order == std::endian::little;
  std::string bytes = std::string("ply\r\nformat ") + (little ? "binary_little_endian" : "binary_big_endian") +
                      " 1.0\r\ncomment made by hand\r\nobj_info nothing\r\n"
                      "element camera 1\r\nproperty double fov\r\nproperty list uchar short name\r\n"
                      "element face 2\r\nproperty uchar red\r\nproperty list ushort uint vertex_indices\r\n"
                      "property list int float texcoord\r\n"
                      "element vertex 4\r\nproperty int8 quality\r\nproperty double z\r\nproperty float y\r\n"
                      "property list uint8 float64 weights\r\nproperty int16 x\r\nproperty float confidence\r\n"
                      "element edge 1\r\nproperty uint32 vertex1\r\nend_header\r\n";
  append(bytes, 60.0, order);
  append(bytes, std::uint8_t{2}, order);
  for (const std::int16_t c : {7, 8}) append(bytes, c, order);
  for (const std::uint32_t last : {2u, 3u}) {
    append(bytes, std::uint8_t{200}, order);
    append(bytes, std::uint16_t{3}, order);
    for (const std::uint32_t corner : {0u, 1u, last}) append(bytes, corner, order);
    append(bytes, std::int32_t{2}, order);
    for (const float coordinate : {0.5F, 0.25F}) append(bytes, coordinate, order);
  }
  for (int i = 0; i < 4; ++i) {
    append(bytes, static_cast<std::int8_t>(-i), order);
    append(bytes, 0.1 * i, order);
    append(bytes, static_cast<float>(i), order);
    append(bytes, static_cast<std::uint8_t>(i), order);
    for (int j = 0; j < i; ++j) append(bytes, 1.0, order);
    append(bytes, static_cast<std::int16_t>(-300 * i), order);
    append(bytes, std::bit_cast<float>(0x7fc00000u), order);  // a NaN that is no coordinate
  }
  append(bytes, std::uint32_t{9}, order);
  return bytes;
}

TEST(Ply, AnythingTheHeaderDeclaresInBothOrders) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    const auto mesh = mesh_of("a.ply", wild_ply(order));
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 3}));
    EXPECT_THAT(mesh.points,
                ElementsAre(Point{0, 0, 0}, Point{-300, 1, 0.1}, Point{-600, 2, 0.2}, Point{-900, 3, 0.1 * 3}));
  }
}

TEST(Ply, EveryCutIsNoticed) {
  const auto whole = wild_ply(std::endian::little);
  for (std::size_t size = 1; size < whole.size(); ++size) {
    const auto thrown = thrown_by([&] { scene::read_ply(std::string_view(whole).substr(0, size), "cut.ply"); });
    ASSERT_EQ(thrown.code, scene::ErrorCode::malformed) << size << " bytes: " << thrown.text;
  }
}

TEST(Ply, AsciiWithOtherElements) {
  const auto mesh = mesh_of("a.ply",
                            "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty "
                            "double y\nproperty double z\nelement rest 1\nproperty list uchar int ids\nelement face "
                            "1\nproperty list uchar int vertex_indices\nproperty uchar flag\nend_header\n"
                            "1 0 0 0\n2 1 0 0\n3 0 1 0\n\n2 7 7\n3 0 1 2 9\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(mesh.points, ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}));
}

std::string binary_stl(std::uint32_t facets, const std::string& head) {
  std::string bytes = head + std::string(80 - head.size(), ' ');
  append(bytes, facets, std::endian::little);
  for (std::uint32_t i = 0; i < facets; ++i) {
    for (int j = 0; j < 3; ++j) append(bytes, std::bit_cast<float>(0x7fc00000u), std::endian::little);  // NaN normal
    for (const float coordinate : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, static_cast<float>(i)}) {
      append(bytes, coordinate, std::endian::little);
    }
    append(bytes, std::uint16_t{0xffff}, std::endian::little);
  }
  return bytes;
}

TEST(Stl, BinaryIsToldByItsSize) {
  const auto mesh = mesh_of("a.stl", binary_stl(2, "solid but binary"));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 3}));
  EXPECT_THAT(mesh.points, ElementsAre(Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 1, 1}));
  EXPECT_THAT(mesh.face_of, ElementsAre(0, 1));
}

TEST(Stl, EveryCutIsNoticed) {
  const auto whole = binary_stl(2, "solid but binary");
  for (std::size_t size = 1; size < whole.size(); ++size) {
    const auto thrown = thrown_by([&] { scene::read_stl(std::string_view(whole).substr(0, size), "cut.stl"); });
    ASSERT_EQ(thrown.code, scene::ErrorCode::malformed) << size << " bytes: " << thrown.text;
  }
}

TEST(Stl, AsciiWithSeveralSolidsInAnyCase) {
  const std::string facet =
      " FACET normal nan nan nan\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 -0\n  endloop\n "
      "endfacet\n";
  const auto mesh =
      mesh_of("a.stl", "SOLID one two facet\n" + facet + "endsolid one two\nsolid\n" + facet + "ENDSOLID");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
}

// Only corners with the same bits share an index: 0 and -0 stay apart.
TEST(Stl, ZeroAndMinusZeroStayApart) {
  const auto mesh = mesh_of("a.stl",
                            "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex -0 0 "
                            "0\nendloop\nendfacet\nendsolid\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Size, AHundredThousandTriangles) {
  constexpr int n = 224;  // 2 * 224^2 = 100352
  std::string text;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      text += "v " + std::to_string(i) + ".1234567890123 " + std::to_string(j) + ".25 0x1.8p+3\n";
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 1; j <= n; ++j) {
      const int a = i * (n + 1) + j;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + n + 2) + " " +
              std::to_string(a + n + 1) + "\n";
    }
  }
  const auto mesh = mesh_of("a.obj", text);
  EXPECT_EQ(mesh.triangles.size(), 100352u);
  EXPECT_TRUE(scene::degenerate_triangles(mesh).empty());
}

}  // namespace
}  // namespace clues::tests
