// D1 from OFF, COFF, NOFF, STOFF and their combinations: one vertex a line, one face a line; what follows the
// coordinates or the corners (normals, colours) is left out.
#include <fmt/format.h>

#include <algorithm>

#include "scene/formats/line_reader.h"
#include "scene/formats/mesh_builder.h"
#include "scene/formats/number.h"
#include "scene/formats/readers.h"

namespace clues::scene {
namespace {

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

[[noreturn]] void fail_truncated(const LineReader& lines, const std::string& missing) {
  fail_at(lines.place(), ErrorCode::malformed,
          "the file ends before " + missing + "; it is truncated, export it again");
}

void check_keyword(std::string_view keyword, const Place& place) {
  auto prefix = keyword;
  if (!prefix.ends_with("OFF")) {
    fail_at(place, ErrorCode::malformed, excerpt(keyword) + " is not the keyword OFF; the file must begin with it");
  }
  prefix.remove_suffix(3);
  for (const std::string_view known : {"ST", "C", "N"}) {
    if (prefix.starts_with(known)) prefix.remove_prefix(known.size());
  }
  if (!prefix.empty()) {
    fail_at(place, ErrorCode::unsupported,
            "the variant " + excerpt(keyword) + " is not supported; export as plain OFF");
  }
}

// The keyword and the counts may share a line.
Counts read_header(LineReader& lines) {
  if (!lines.next()) fail_truncated(lines, "the keyword OFF");
  auto tokens = lines.tokens();
  check_keyword(tokens[0], lines.place());
  tokens.erase(tokens.begin());
  if (tokens.empty()) {
    if (!lines.next()) fail_truncated(lines, "the counts");
    tokens = lines.tokens();
  }
  if (tokens[0] == "BINARY") {
    fail_at(lines.place(), ErrorCode::unsupported, "binary OFF is not supported; export as text or as binary PLY");
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

void read_face(const LineReader& lines, std::vector<std::int64_t>& corners, MeshBuilder& builder) {
  const auto& tokens = lines.tokens();
  const auto count = parse_integer(tokens[0]);
  if (!count || *count < 0) {
    fail_at(lines.place(), ErrorCode::malformed,
            excerpt(tokens[0]) + " is not the number of corners of a face; correct it");
  }
  if (*count > static_cast<std::int64_t>(tokens.size()) - 1) {
    fail_at(lines.place(), ErrorCode::malformed,
            fmt::format("the face says {} corners, but names {}; correct it", *count, tokens.size() - 1));
  }
  corners.clear();
  for (std::size_t i = 1; i <= static_cast<std::size_t>(*count); ++i) {
    const auto index = parse_integer(tokens[i]);
    if (!index) {
      fail_at(lines.place(), ErrorCode::malformed, "the corner " + excerpt(tokens[i]) + " is not an index; correct it");
    }
    corners.push_back(*index);
  }
  builder.add_face(corners, lines.place());
}

}  // namespace

TriangleMesh read_off(std::string_view bytes, const std::string& file) {
  LineReader lines(file, bytes, {});
  const auto counts = read_header(lines);
  MeshBuilder builder(file, 0);
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    if (!lines.next()) fail_truncated(lines, fmt::format("vertex {} of {}", i, counts.vertices));
    read_vertex(lines, builder);
  }
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    if (!lines.next()) fail_truncated(lines, fmt::format("face {} of {}", i, counts.faces));
    read_face(lines, corners, builder);
  }
  if (lines.next()) {
    fail_at(lines.place(), ErrorCode::malformed,
            fmt::format("more lines than the {} vertices and {} faces that the header counts; correct the counts",
                        counts.vertices, counts.faces));
  }
  return builder.take();
}

}  // namespace clues::scene
