// The header of a PLY file: its format, and its elements with their properties in file order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace clues::scene {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);  // bytes
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  // of the value, or of each entry of the list
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;  // at least one
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;         // bytes up to the first one of the body
  std::uint64_t body_line = 1;  // the line there
};

// Throws Error malformed or unsupported, naming file and line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& file);

}  // namespace clues::scene
