// D1 from OFF, COFF, NOFF, STOFF and their combinations, also without the keyword. Text with one vertex a line and one face a line, where what follows
// the coordinates or the corners (normals, colours) is left out; text in free layout, which must hold the coordinates and corners and nothing else;
// and bytes (off_binary.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scene/formats/line_reader.h"
#include "scene/formats/mesh_builder.h"
#include "scene/formats/number.h"
#include "scene/formats/off_header.h"
#include "scene/formats/readers.h"

namespace clues::scene {
namespace {

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

[[noreturn]] void fail_truncated(const Place& place, const std::string& missing) {
  fail_at(place, ErrorCode::malformed, "the file ends before " + missing + "; it is truncated, export it again");
}

// The keyword and the counts may share a line; without the keyword it is all counts.
Counts read_header(LineReader& lines) {
  if (!lines.next()) fail_truncated(lines.place(), "the keyword OFF");
  auto tokens = lines.tokens();
  if (!parse_integer(tokens[0])) {
    off_extras(tokens[0], lines.place());
    tokens.erase(tokens.begin());
  }
  if (tokens.empty()) {
    if (!lines.next()) fail_truncated(lines.place(), "the counts");
    tokens = lines.tokens();
  }
  const auto vertices = parse_integer(tokens[0]);
  const auto faces = tokens.size() > 1 ? parse_integer(tokens[1]) : std::nullopt;
  const bool edges_fine = tokens.size() == 2 || (tokens.size() == 3 && parse_integer(tokens[2]));
  if (!vertices || !faces || !edges_fine || *vertices < 0 || *faces < 0) {
    fail_at(lines.place(), ErrorCode::malformed,
            "this line must hold the counts of vertices, faces and edges; correct it");
  }
  return {*vertices, *faces};
}

void read_vertex(const LineReader& lines, MeshBuilder& builder) {
  const auto& tokens = lines.tokens();
  if (tokens.size() < 3) {
    fail_at(lines.place(), ErrorCode::malformed,
            fmt::format("vertex {} has {} coordinates; write: x y z", builder.point_count(), tokens.size()));
  }
  for (std::size_t i = 3; i < tokens.size(); ++i) {
    if (parse_number(tokens[i]).kind == NumberKind::not_a_number) {
      fail_at(lines.place(), ErrorCode::malformed, excerpt(tokens[i]) + " after a vertex is not a number; remove it");
    }
  }
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = number_at(tokens[axis], "coordinate", lines.place());
  builder.add_point(point, lines.place());
}

std::int64_t corner_count(std::string_view token, const Place& place) {
  const auto count = parse_integer(token);
  if (!count || *count < 0) {
    fail_at(place, ErrorCode::malformed, excerpt(token) + " is not the number of corners of a face; correct it");
  }
  return *count;
}

std::int64_t corner_at(std::string_view token, const Place& place) {
  const auto index = parse_integer(token);
  if (!index) fail_at(place, ErrorCode::malformed, "the corner " + excerpt(token) + " is not an index; correct it");
  return *index;
}

void read_face(const LineReader& lines, std::vector<std::int64_t>& corners, MeshBuilder& builder) {
  const auto& tokens = lines.tokens();
  const auto count = corner_count(tokens[0], lines.place());
  if (count > static_cast<std::int64_t>(tokens.size()) - 1) {
    fail_at(lines.place(), ErrorCode::malformed,
            fmt::format("the face says {} corners, but names {}; correct it", count, tokens.size() - 1));
  }
  corners.clear();
  for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i)
    corners.push_back(corner_at(tokens[i], lines.place()));
  builder.add_face(corners, lines.place());
}

TriangleMesh read_lines(std::string_view bytes, const std::string& file) {
  LineReader lines(file, bytes, {});
  const auto counts = read_header(lines);
  MeshBuilder builder(file, 0);
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    if (!lines.next()) fail_truncated(lines.place(), fmt::format("vertex {} of {}", i, counts.vertices));
    read_vertex(lines, builder);
  }
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    if (!lines.next()) fail_truncated(lines.place(), fmt::format("face {} of {}", i, counts.faces));
    read_face(lines, corners, builder);
  }
  if (lines.next()) {
    fail_at(lines.place(), ErrorCode::malformed,
            fmt::format("more lines than the {} vertices and {} faces that the header counts; correct the counts",
                        counts.vertices, counts.faces));
  }
  return builder.take();
}

// ---- free layout

// The words of a file, across lines.
class Words {
 public:
  Words(std::string_view bytes, const std::string& file) : lines_(file, bytes, {}) {}

  bool at_end() {
    while (next_ == lines_.tokens().size()) {
      next_ = 0;
      if (!lines_.next()) return true;
    }
    return false;
  }
  std::string_view take() {
    if (at_end()) fail_truncated(place(), "its last number");
    return lines_.tokens()[next_++];
  }
  std::string_view look() { return at_end() ? std::string_view() : lines_.tokens()[next_]; }
  std::int64_t take_count() { return corner_count(take(), place()); }
  Place place() const { return lines_.place(); }

 private:
  LineReader lines_;
  std::size_t next_ = 0;
};

// Every word must have its use: nothing else tells that a text is meant so.
TriangleMesh read_words(std::string_view bytes, const std::string& file) {
  Words words(bytes, file);
  if (!parse_integer(words.look())) off_extras(words.take(), words.place());
  const auto vertices = words.take_count(), faces = words.take_count();
  words.take_count();  // edges
  MeshBuilder builder(file, 0);
  for (std::int64_t i = 0; i < vertices; ++i) {
    Point point{};
    for (double& x : point) {
      const auto word = words.take();
      x = number_at(word, "coordinate", words.place());
    }
    builder.add_point(point, words.place());
  }
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < faces; ++i) {
    corners.clear();
    for (auto left = words.take_count(); left > 0; --left) {
      const auto word = words.take();
      corners.push_back(corner_at(word, words.place()));
    }
    builder.add_face(corners, words.place());
  }
  if (!words.at_end()) fail_at(words.place(), ErrorCode::malformed, "more numbers than the header counts");
  return builder.take();
}

std::optional<TriangleMesh> in_free_layout(std::string_view bytes, const std::string& file) {
  try {
    return read_words(bytes, file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

int off_extras(std::string_view keyword, const Place& place) {
  auto prefix = keyword;
  if (!prefix.ends_with("OFF")) {
    fail_at(place, ErrorCode::malformed,
            excerpt(keyword) + " is not the keyword OFF; the file must begin with it, or with its counts");
  }
  prefix.remove_suffix(3);
  int extras = 0;
  const std::pair<std::string_view, int> known[] = {{"ST", 2}, {"C", 4}, {"N", 3}};
  for (const auto& [name, numbers] : known) {
    if (!prefix.starts_with(name)) continue;
    prefix.remove_prefix(name.size());
    extras += numbers;
  }
  if (!prefix.empty()) {
    fail_at(place, ErrorCode::unsupported,
            "the variant " + excerpt(keyword) + " is not supported; export as plain OFF");
  }
  return extras;
}

TriangleMesh read_off(std::string_view bytes, const std::string& file) {
  if (is_binary_off(bytes)) return read_binary_off(bytes, file);
  try {
    return read_lines(bytes, file);
  } catch (const Error& error) {
    // Its layout may be another. If it is not, what is wrong is wrong with the lines.
    if (error.code() != ErrorCode::malformed) throw;
    if (auto mesh = in_free_layout(bytes, file)) return std::move(*mesh);
    throw;
  }
}

}  // namespace clues::scene
