// D1 from STL, ascii and binary. STL has no vertex list: corners with the same 192 bits share an index, and no others do.
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_map>

#include "scene/formats/line_reader.h"
#include "scene/formats/mesh_builder.h"
#include "scene/formats/number.h"
#include "scene/formats/readers.h"
#include "scene/messages/warning.h"

namespace clues::scene {
namespace {

using Bits = std::array<std::uint64_t, 3>;

struct BitsHash {
  std::size_t operator()(const Bits& bits) const {
    std::uint64_t hash = 0;
    for (const auto word : bits) {
      hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

class CornerTable {
 public:
  explicit CornerTable(MeshBuilder& builder) : builder_(builder) {}

  std::int64_t index_of(const Point& point, const Place& place) {
    const auto next = static_cast<std::int64_t>(builder_.point_count());
    const auto [entry, is_new] = index_of_.try_emplace(std::bit_cast<Bits>(point), next);
    if (is_new) builder_.add_point(point, place);
    return entry->second;
  }

 private:
  MeshBuilder& builder_;
  std::unordered_map<Bits, std::int64_t, BitsHash> index_of_;
};

constexpr std::size_t header_size = 84;  // 80 bytes of anything and the number of triangles
constexpr std::size_t facet_size = 50;   // normal and three corners as floats, two bytes of attributes

std::uint32_t little_endian_word(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return word;
}

TriangleMesh read_binary(std::string_view bytes, const std::string& file) {
  MeshBuilder builder(file, 0);
  CornerTable table(builder);
  const std::uint32_t count = little_endian_word(bytes, header_size - 4);
  for (std::uint32_t face = 0; face < count; ++face) {
    const Place place{file, "face", face};
    std::array<std::int64_t, 3> corners{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Point point{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto offset = header_size + face * facet_size + 12 + corner * 12 + axis * 4;
        point[axis] = std::bit_cast<float>(little_endian_word(bytes, offset));
      }
      corners[corner] = table.index_of(point, place);
    }
    builder.add_face(corners, place);
  }
  return builder.take();
}

std::string lower_case(std::string_view token) {
  std::string text(token);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

// The words of an ascii STL, across lines.
class WordReader {
 public:
  WordReader(std::string_view bytes, const std::string& file) : lines_(file, bytes, {.hash_comments = false}) {}

  bool at_end() { return !fill(); }
  void skip_line() { next_ = lines_.tokens().size(); }
  Place place() const { return lines_.place(); }

  std::string_view take(std::string_view expected) {
    if (!fill()) {
      fail_at(place(), ErrorCode::malformed,
              fmt::format("the file ends where '{}' is expected; it is truncated, export it again", expected));
    }
    return lines_.tokens()[next_++];
  }

  // In lower case; "end solid" and the like count as one word.
  std::string take_word(std::string_view expected) {
    const auto word = lower_case(take(expected));
    return word == "end" ? word + lower_case(take(expected)) : word;
  }

  void expect(std::string_view word) {
    const auto token = take_word(word);
    if (token != word) {
      fail_at(place(), ErrorCode::malformed,
              fmt::format("{} stands where '{}' is expected; correct it", excerpt(token), word));
    }
  }

 private:
  bool fill() {
    if (next_ < lines_.tokens().size()) return true;
    next_ = 0;
    return lines_.next();
  }

  LineReader lines_;
  std::size_t next_ = 0;
};

void read_facet(WordReader& words, CornerTable& table, std::vector<std::int64_t>& corners, MeshBuilder& builder) {
  const Place place = words.place();
  words.expect("normal");
  for (int i = 0; i < 3; ++i) {  // often nan for a degenerate triangle; it is not used
    const auto token = words.take("a normal");
    if (parse_number(token).kind == NumberKind::not_a_number) {
      fail_at(words.place(), ErrorCode::malformed, "the normal " + excerpt(token) + " is not a number; correct it");
    }
  }
  words.expect("outer");
  words.expect("loop");
  corners.clear();
  while (true) {
    const auto word = words.take_word("vertex");
    if (word == "endloop") break;
    if (word != "vertex") {
      fail_at(words.place(), ErrorCode::malformed, excerpt(word) + " stands where 'vertex' is expected; correct it");
    }
    Point point{};
    for (auto& coordinate : point) {
      const auto number = words.take("a coordinate");
      coordinate = number_at(number, "coordinate", words.place());
    }
    corners.push_back(table.index_of(point, words.place()));
  }
  words.expect("endfacet");
  if (corners.size() < 3) {  // not a line, as elsewhere: a facet that was damaged
    fail_at(place, ErrorCode::malformed, fmt::format("a facet with {} corners; export it again", corners.size()));
  }
  builder.add_face(corners, place);
}

TriangleMesh read_ascii(std::string_view bytes, const std::string& file) {
  WordReader words(bytes, file);
  MeshBuilder builder(file, 0);
  CornerTable table(builder);
  std::vector<std::int64_t> corners;
  while (!words.at_end()) {
    words.expect("solid");
    words.skip_line();  // the solid's name
    while (true) {
      const auto word = words.take_word("endsolid");
      if (word == "endsolid") break;
      if (word != "facet") {
        fail_at(words.place(), ErrorCode::malformed, excerpt(word) + " stands where 'facet' is expected; correct it");
      }
      read_facet(words, table, corners, builder);
    }
    words.skip_line();
  }
  return builder.take();
}

// Without a byte order mark, leading blanks, and what some programs append.
std::string_view text_of(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  const auto end = bytes.find_last_not_of(std::string_view("\0\x1a", 2));
  return bytes.substr(begin, end + 1 - begin);
}

}  // namespace

// Binary is told by its size: many a binary file begins with the word "solid" too. What is longer and no text is binary with something appended.
TriangleMesh read_stl(std::string_view bytes, const std::string& file) {
  const bool has_header = bytes.size() >= header_size;
  const std::uint64_t count = has_header ? little_endian_word(bytes, header_size - 4) : 0;
  const std::uint64_t needed = header_size + facet_size * count;
  if (has_header && bytes.size() == needed) return read_binary(bytes, file);
  const auto text = text_of(bytes);
  const bool is_text =
      text.size() >= 5 && lower_case(text.substr(0, 5)) == "solid" && text.find('\0') == std::string_view::npos;
  if (is_text)
    return read_ascii(bytes.substr(0, static_cast<std::size_t>(text.data() + text.size() - bytes.data())), file);
  if (!has_header) {
    fail_in(file, ErrorCode::malformed,
            "neither ascii STL (no 'solid') nor binary STL (below 84 bytes); export it again");
  }
  if (count > 0 && bytes.size() > needed) {
    warn(fmt::format("{}: {} bytes after the last of the {} triangles were left out", file, bytes.size() - needed,
                     count));
    return read_binary(bytes, file);
  }
  fail_in(file, ErrorCode::malformed,
          fmt::format("as binary STL its {} triangles need {} bytes, but the file has {}; it is truncated or no STL, "
                      "export it again",
                      count, needed, bytes.size()));
}

}  // namespace clues::scene
