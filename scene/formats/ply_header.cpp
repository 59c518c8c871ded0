// The header of a PLY file (D1 input).
#include "scene/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"

namespace clues::scene {
namespace {

PlyType type_of(std::string_view name, const Place& place) {
  using Entry = std::pair<std::string_view, PlyType>;
  constexpr std::array<Entry, 16> names = {{{"char", PlyType::int8},
                                            {"int8", PlyType::int8},
                                            {"uchar", PlyType::uint8},
                                            {"uint8", PlyType::uint8},
                                            {"short", PlyType::int16},
                                            {"int16", PlyType::int16},
                                            {"ushort", PlyType::uint16},
                                            {"uint16", PlyType::uint16},
                                            {"int", PlyType::int32},
                                            {"int32", PlyType::int32},
                                            {"uint", PlyType::uint32},
                                            {"uint32", PlyType::uint32},
                                            {"float", PlyType::float32},
                                            {"float32", PlyType::float32},
                                            {"double", PlyType::float64},
                                            {"float64", PlyType::float64}}};
  for (const auto& [known, type] : names) {
    if (known == name) return type;
  }
  fail_at(place, ErrorCode::unsupported, "the type " + excerpt(name) + " is not one of PLY; export with a usual type");
}

PlyFormat format_of(const std::vector<std::string_view>& tokens, const Place& place) {
  if (tokens.size() != 3) fail_at(place, ErrorCode::malformed, "write: format ascii 1.0 (or binary_...)");
  if (tokens[2] != "1.0") {
    fail_at(place, ErrorCode::unsupported,
            "the version " + excerpt(tokens[2]) + " is not supported; export as PLY 1.0");
  }
  if (tokens[1] == "ascii") return PlyFormat::ascii;
  if (tokens[1] == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (tokens[1] == "binary_big_endian") return PlyFormat::binary_big_endian;
  fail_at(
      place, ErrorCode::unsupported,
      "the format " + excerpt(tokens[1]) + " is not ascii, binary_little_endian or binary_big_endian; export again");
}

PlyElement element_of(const std::vector<std::string_view>& tokens, const Place& place) {
  const auto count = tokens.size() == 3 ? parse_integer(tokens[2]) : std::nullopt;
  if (!count || *count < 0)
    fail_at(place, ErrorCode::malformed, "not an element with a count; write: element NAME COUNT");
  return {std::string(tokens[1]), static_cast<std::uint64_t>(*count), {}};
}

PlyProperty property_of(const std::vector<std::string_view>& tokens, const Place& place) {
  PlyProperty property;
  property.is_list = tokens.size() == 5 && tokens[1] == "list";
  if (!property.is_list && tokens.size() != 3) {
    fail_at(place, ErrorCode::malformed, "not a property; write: property TYPE NAME or property list TYPE TYPE NAME");
  }
  property.name = tokens.back();
  property.type = type_of(tokens[tokens.size() - 2], place);
  if (!property.is_list) return property;
  property.count_type = type_of(tokens[2], place);
  if (!is_integer(property.count_type)) {
    fail_at(place, ErrorCode::malformed,
            "the length of a list cannot have the type " + excerpt(tokens[2]) + "; use uchar");
  }
  return property;
}

// The header's lines end as its first one does; in a binary file that decides where the body begins.
class HeaderLines {
 public:
  HeaderLines(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {
    const auto first_end = bytes.find_first_of("\r\n");
    if (first_end == std::string_view::npos || bytes.substr(0, first_end) != "ply") {
      fail_in(file, ErrorCode::malformed, "the first line is not 'ply'; it is no PLY file, export it again");
    }
    ending_ = bytes.substr(first_end).starts_with("\r\n") ? "\r\n" : bytes[first_end] == '\r' ? "\r" : "\n";
    used_ = first_end + ending_.size();
  }

  std::string_view take() {
    ++line_;
    const auto end = bytes_.find(ending_, used_);
    if (end == std::string_view::npos) {
      fail_at(place(), ErrorCode::malformed, "the file ends before end_header; it is truncated, export it again");
    }
    const auto line = bytes_.substr(used_, end - used_);
    used_ = end + ending_.size();
    return line;
  }

  Place place() const { return {file_, {}, line_}; }
  std::size_t used() const { return used_; }
  std::uint64_t line() const { return line_; }

 private:
  std::string_view bytes_;
  std::string_view file_;
  std::string_view ending_;
  std::size_t used_ = 0;
  std::uint64_t line_ = 1;
};

void check_elements(const std::vector<PlyElement>& elements, const Place& place) {
  for (const auto& element : elements) {
    const auto same_name = [&](const PlyElement& other) { return other.name == element.name; };
    if (std::count_if(elements.begin(), elements.end(), same_name) > 1) {
      fail_at(place, ErrorCode::malformed, "the element " + excerpt(element.name) + " is declared twice; remove one");
    }
    if (element.properties.empty() && element.count > 0) {
      fail_at(place, ErrorCode::malformed, "the element " + excerpt(element.name) + " has no property; declare one");
    }
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  throw Error(ErrorCode::internal, "a PLY type without a size");
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyHeader read_ply_header(std::string_view bytes, const std::string& file) {
  HeaderLines lines(bytes, file);
  PlyHeader header;
  bool has_format = false;
  while (true) {
    LineReader words(file, lines.take(), {.hash_comments = false});
    if (!words.next()) continue;
    const auto& tokens = words.tokens();
    const auto place = lines.place();
    if (tokens[0] == "end_header") break;
    if (tokens[0] == "format") {
      header.format = format_of(tokens, place);
      has_format = true;
    } else if (tokens[0] == "element") {
      header.elements.push_back(element_of(tokens, place));
    } else if (tokens[0] == "property") {
      if (header.elements.empty()) fail_at(place, ErrorCode::malformed, "a property before any element; move it");
      header.elements.back().properties.push_back(property_of(tokens, place));
    } else if (tokens[0] != "comment" && tokens[0] != "obj_info") {
      fail_at(place, ErrorCode::malformed, excerpt(tokens[0]) + " is not a keyword of a PLY header; remove the line");
    }
  }
  if (!has_format)
    fail_at(lines.place(), ErrorCode::malformed, "the header has no 'format' line; add: format ascii 1.0");
  check_elements(header.elements, lines.place());
  header.size = lines.used();
  header.body_line = lines.line() + 1;
  return header;
}

}  // namespace clues::scene
