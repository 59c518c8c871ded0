// D1: the coordinates are the file's, bit for bit, in every format that can carry them.
#include <gmock/gmock.h>

#include <array>
#include <cfloat>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "scene/formats/number.h"
#include "tests/scene/support.h"

namespace clues::tests {
namespace {

using scene::NumberKind;
using scene::Point;

// Doubles that a careless reader changes: 17 digits, signed zero, subnormals, both ends, what a float cannot hold.
const std::vector<Point> hazards = {
    {0.1, 1.0 / 3.0, 0x1.fffffffffffffp+0},
    {-0.0, 0.0, 0x1p-1074},
    {-0x1p-1074, 0x0.fffffffffffffp-1022, 0x1p-1022},
    {DBL_MAX, -DBL_MAX, 0x1.0000000000001p+0},
    {9007199254740993.0, 16777217.0, 123456789.12345678},
    {5e-324, 2.2250738585072011e-308, 6.02214076e23},
};

enum class Notation { digits_17, hex };

std::string text_of(double value, Notation notation) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), notation == Notation::hex ? "%a" : "%.17g", value);
  return text.data();
}

std::string lines_of(const std::vector<Point>& points, const std::string& start, Notation notation) {
  std::string text;
  for (const auto& point : points) {
    text += start;
    for (const double coordinate : point) text += text_of(coordinate, notation) + " ";
    text += "\n";
  }
  return text;
}

std::string ply_header(const std::string& format, const std::string& type, std::size_t points) {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(points) + "\n";
  for (const char* name : {"x", "y", "z"}) text += "property " + type + " " + name + "\n";
  return text + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

template <class Real>
std::string binary_ply(const std::vector<Point>& points, std::endian order) {
  const bool little = order == std::endian::little;
  auto bytes = ply_header(little ? "binary_little_endian" : "binary_big_endian", sizeof(Real) == 4 ? "float" : "double",
                          points.size());
  for (const auto& point : points) {
    for (const double coordinate : point) append(bytes, static_cast<Real>(coordinate), order);
  }
  append(bytes, std::uint8_t{3}, order);
  for (const std::int32_t corner : {0, 1, 2}) append(bytes, corner, order);
  return bytes;
}

class TextFormats : public testing::TestWithParam<Notation> {};

TEST_P(TextFormats, ObjKeepsEveryBit) {
  EXPECT_EQ(bits_of(mesh_of("a.obj", lines_of(hazards, "v ", GetParam()) + "f 1 2 3\n").points), bits_of(hazards));
}

TEST_P(TextFormats, OffKeepsEveryBit) {
  const auto text = "OFF\n6 1 0\n" + lines_of(hazards, "", GetParam()) + "3 0 1 2\n";
  EXPECT_EQ(bits_of(mesh_of("a.off", text).points), bits_of(hazards));
}

TEST_P(TextFormats, AsciiPlyKeepsEveryBit) {
  for (const std::string type : {"double", "float"}) {  // text is read to the nearest double whatever the type
    const auto text = ply_header("ascii", type, 6) + lines_of(hazards, "", GetParam()) + "3 0 1 2\n";
    EXPECT_EQ(bits_of(mesh_of("a.ply", text).points), bits_of(hazards));
  }
}

TEST_P(TextFormats, AsciiStlKeepsEveryBit) {
  std::string text = "solid\n";
  for (std::size_t i = 0; i < hazards.size(); i += 3) {
    const std::vector<Point> corners(hazards.begin() + static_cast<std::ptrdiff_t>(i),
                                     hazards.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    text += "facet normal 0 0 0\nouter loop\n" + lines_of(corners, "vertex ", GetParam()) + "endloop\nendfacet\n";
  }
  EXPECT_EQ(bits_of(mesh_of("a.stl", text + "endsolid\n").points), bits_of(hazards));
}

INSTANTIATE_TEST_SUITE_P(Notations, TextFormats, testing::Values(Notation::digits_17, Notation::hex),
                         [](const auto& test) { return test.param == Notation::hex ? "Hex" : "Digits17"; });

TEST(BinaryFormats, DoublePlyKeepsEveryBitInBothOrders) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    EXPECT_EQ(bits_of(mesh_of("a.ply", binary_ply<double>(hazards, order)).points), bits_of(hazards));
  }
}

const std::vector<Point> float_hazards = {
    {0.1F, -0.0, 0x1p-149}, {-0x1p-149, FLT_MAX, 1.0F / 3.0F}, {16777215.0, FLT_MIN, 0x1.fffffep+0}};

TEST(BinaryFormats, FloatPlyKeepsEveryBitInBothOrders) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    EXPECT_EQ(bits_of(mesh_of("a.ply", binary_ply<float>(float_hazards, order)).points), bits_of(float_hazards));
  }
}

TEST(BinaryFormats, StlKeepsEveryBit) {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{1}, std::endian::little);
  for (int i = 0; i < 3; ++i) append(bytes, 0.0F, std::endian::little);
  for (const auto& point : float_hazards) {
    for (const double coordinate : point) append(bytes, static_cast<float>(coordinate), std::endian::little);
  }
  append(bytes, std::uint16_t{0}, std::endian::little);
  EXPECT_EQ(bits_of(mesh_of("a.stl", bytes).points), bits_of(float_hazards));
}

TEST(ParseNumber, AgreesWithTheBitsItWasPrintedFrom) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    for (const auto notation : {Notation::digits_17, Notation::hex}) {
      const auto parsed = scene::parse_number(text_of(value, notation));
      ASSERT_EQ(parsed.kind, NumberKind::finite) << text_of(value, notation);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(parsed.value), std::bit_cast<std::uint64_t>(value))
          << text_of(value, notation);
    }
  }
}

// A second opinion: the C library, on text that lies anywhere between two doubles.
TEST(ParseNumber, AgreesWithTheCLibraryOnLongDecimals) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s%d.%016" PRIu64 "%06de%d", random() % 2 != 0 ? "-" : "",
                  static_cast<int>(random() % 10), random() % 10000000000000000u, static_cast<int>(random() % 1000000),
                  static_cast<int>(random() % 640) - 330);
    const auto parsed = scene::parse_number(text.data());
    const double expected = std::strtod(text.data(), nullptr);
    ASSERT_EQ(parsed.kind, std::isfinite(expected) ? NumberKind::finite : NumberKind::non_finite) << text.data();
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parsed.value), std::bit_cast<std::uint64_t>(expected)) << text.data();
  }
}

TEST(ParseNumber, TiesGoToEven) {
  EXPECT_EQ(scene::parse_number("9007199254740993").value, 9007199254740992.0);
  EXPECT_EQ(scene::parse_number("9007199254740995").value, 9007199254740996.0);
  EXPECT_EQ(scene::parse_number("9007199254740993.0000000000000000000000001").value, 9007199254740994.0);
  EXPECT_EQ(scene::parse_number("0x1.00000000000008p+0").value, 1.0);
  EXPECT_EQ(scene::parse_number("0x1.00000000000018p+0").value, 0x1.0000000000002p+0);
  EXPECT_EQ(scene::parse_number("0x1.8p-1075").value, 0x1p-1074);
  EXPECT_EQ(scene::parse_number("0x1p-1075").value, 0.0);
}

TEST(ParseNumber, Forms) {
  for (const char* text : {"1", "+1", "1.", "01", "1e0", "1E+00", "0x1", "0X1P0", "10e-1", ".1e1"}) {
    EXPECT_EQ(scene::parse_number(text).kind, NumberKind::finite) << text;
    EXPECT_EQ(scene::parse_number(text).value, 1.0) << text;
  }
  EXPECT_EQ(scene::parse_number("0x1.8p+3").value, 12.0);
  EXPECT_EQ(scene::parse_number("-0x1p-1074").value, -0x1p-1074);
  for (const char* text :
       {"nan", "NaN", "-nan", "inf", "-Infinity", "+INF", "1e999", "-1e309", "0x1p1024", "1.7976931348623159e308"}) {
    EXPECT_EQ(scene::parse_number(text).kind, NumberKind::non_finite) << text;
  }
  for (const char* text : {"1e-400", "0x1p-2000"}) {
    EXPECT_EQ(scene::parse_number(text).kind, NumberKind::finite) << text;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(scene::parse_number(text).value), 0u) << text;
  }
  EXPECT_TRUE(std::signbit(scene::parse_number("-1e-400").value));
  for (const char* text : {"", "-", "+", "--1", "+-1", "-+1", "1,5", "1f", "1d0", "e1", ".", "0x", "0xg", "x", "1 ",
                           " 1", "infinit", "0x1p", "1e"}) {
    EXPECT_EQ(scene::parse_number(text).kind, NumberKind::not_a_number) << text;
  }
}

}  // namespace
}  // namespace clues::tests
