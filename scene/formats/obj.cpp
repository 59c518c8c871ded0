// D1 from Wavefront OBJ: v and f; what is no surface is left out; what is a surface but no polygon is refused,
// because leaving it out would change what is visible.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/formats/line_reader.h"
#include "scene/formats/mesh_builder.h"
#include "scene/formats/number.h"
#include "scene/formats/readers.h"

namespace clues::scene {
namespace {

// Points, lines, normals, texture, grouping and display: no surface.
constexpr std::array no_surface = {"vt",     "vn",     "vp",       "g",          "o",         "s",     "usemtl",
                                   "mtllib", "l",      "p",        "mg",         "lod",       "bevel", "c_interp",
                                   "usemap", "maplib", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech"};
// Free-form geometry and files within files.
constexpr std::array other_surface = {"surf", "curv", "curv2", "cstype", "deg", "bmat", "step",
                                      "parm", "trim", "hole",  "scrv",   "sp",  "end",  "con",
                                      "call", "csh",  "cdc",   "cdp",    "bzp", "bsp",  "res"};

template <std::size_t n>
bool is_in(const std::array<const char*, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

Point vertex_of(const std::vector<std::string_view>& tokens, const Place& place) {
  if (tokens.size() < 4) {
    fail_at(place, ErrorCode::malformed,
            fmt::format("a vertex with {} coordinates; write: v x y z", tokens.size() - 1));
  }
  // What follows x y z is a weight or a colour.
  for (std::size_t i = 4; i < tokens.size(); ++i) {
    if (parse_number(tokens[i]).kind == NumberKind::not_a_number) {
      fail_at(place, ErrorCode::malformed, excerpt(tokens[i]) + " after a vertex is not a number; remove it");
    }
  }
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = number_at(tokens[axis + 1], "coordinate", place);
  return point;
}

// i, i/j, i//k or i/j/k: the vertex index i, with the rest checked for its form only. Some write i/ and i// for i.
std::int64_t corner_index(std::string_view token, const Place& place) {
  const auto first = token.substr(0, token.find('/'));
  auto rest = token.substr(first.size());
  bool well_formed = true;
  for (int part = 1; !rest.empty(); ++part) {
    rest.remove_prefix(1);
    const auto field = rest.substr(0, rest.find('/'));
    rest.remove_prefix(field.size());
    well_formed = well_formed && part <= 2 && (field.empty() || parse_integer(field).has_value());
  }
  const auto index = parse_integer(first);
  if (!index || !well_formed) {
    fail_at(place, ErrorCode::malformed, "the corner " + excerpt(token) + " is not i, i/j, i//k or i/j/k; correct it");
  }
  return *index;
}

// From 1 up, or from -1 (the vertex before this line) down, to from 0 up.
std::int64_t from_zero(std::int64_t index, std::size_t points, const Place& place) {
  if (index == 0) {
    fail_at(place, ErrorCode::index_out_of_range, "the face names vertex 0, but OBJ counts from 1; correct the index");
  }
  if (index > 0) return index - 1;
  const auto count = static_cast<std::int64_t>(points);
  if (index < -count) {
    fail_at(
        place, ErrorCode::index_out_of_range,
        fmt::format("the face names vertex {}, but only {} vertices come before it; correct the index", index, count));
  }
  return count + index;
}

}  // namespace

TriangleMesh read_obj(std::string_view bytes, const std::string& file) {
  LineReader lines(file, bytes, {.hash_comments = true, .backslash_continues = true});
  MeshBuilder builder(file, 1);
  std::vector<std::int64_t> corners;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    const auto keyword = tokens[0];
    if (keyword == "v") {
      builder.add_point(vertex_of(tokens, lines.place()), lines.place());
    } else if (keyword == "f" || keyword == "fo") {  // its name of old
      corners.clear();
      for (std::size_t i = 1; i < tokens.size(); ++i) {
        const auto index = corner_index(tokens[i], lines.place());
        corners.push_back(from_zero(index, builder.point_count(), lines.place()));
      }
      builder.add_face(corners, lines.place());
    } else if (is_in(other_surface, keyword)) {
      fail_at(lines.place(), ErrorCode::unsupported,
              "the keyword " + excerpt(keyword) + " is not supported; export the scene as polygons");
    } else if (!is_in(no_surface, keyword)) {
      fail_at(lines.place(), ErrorCode::malformed, excerpt(keyword) + " is not a keyword of OBJ; remove the line");
    }
  }
  return builder.take();
}

}  // namespace clues::scene
