#include "scene/multires/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "scene/formats/file_bytes.h"
#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/formats/ply_body.h"
#include "scene/formats/ply_header.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"

namespace clues::scene {
namespace {

constexpr Triangle no_texture{no_vertex, no_vertex, no_vertex};

// The mesh was read before, and somebody may have written the file since: its vertices are those of the mesh, or it is refused.
void require_one_per_vertex(std::size_t count, const TriangleMesh& mesh, const std::string& file) {
  if (count != mesh.points.size())
    throw Error(ErrorCode::bad_argument, fmt::format("{}: changed while it was read", file));
}

// The corners of a face to its triangles, which are those of the mesh with its number: a fan from the first corner.
class Corners {
 public:
  explicit Corners(const TriangleMesh& mesh) : mesh_(mesh), corners_(mesh.triangles.size(), no_texture) {}

  // Of the next face. A corner without coordinates: no_vertex.
  void add_face(const std::vector<std::uint32_t>& face) {
    const bool all = std::find(face.begin(), face.end(), no_vertex) == face.end();
    for (std::size_t i = 1; next_ < corners_.size() && mesh_.face_of[next_] == faces_; ++i, ++next_) {
      if (!all || i + 1 >= face.size()) continue;
      corners_[next_] = {face[0], face[i], face[i + 1]};
      any_ = true;
    }
    ++faces_;
  }
  std::vector<Triangle> take() { return any_ ? std::move(corners_) : std::vector<Triangle>(); }

 private:
  const TriangleMesh& mesh_;
  std::vector<Triangle> corners_;
  std::size_t next_ = 0;
  std::uint32_t faces_ = 0;
  bool any_ = false;
};

// The middle of i/j/k, from 0; no_vertex where there is none. Positive ones may be read later.
std::uint32_t texture_index(std::string_view token, std::size_t before, const Place& place) {
  const auto first = token.find('/');
  if (first == std::string_view::npos) return no_vertex;
  const auto rest = token.substr(first + 1);
  const auto index = parse_integer(rest.substr(0, rest.find('/')));
  if (!index) return no_vertex;
  const std::int64_t from_zero = *index > 0 ? *index - 1 : static_cast<std::int64_t>(before) + *index;
  if (*index == 0 || from_zero < 0 || from_zero >= no_vertex) {
    fail_at(place, ErrorCode::index_out_of_range,
            fmt::format("the face names texture vertex {}; {} come before it", *index, before));
  }
  return static_cast<std::uint32_t>(from_zero);
}

MeshAttributes of_obj(std::string_view bytes, const std::string& file, const TriangleMesh& mesh) {
  LineReader lines(file, bytes, {.hash_comments = true, .backslash_continues = true});
  MeshAttributes out;
  Corners corners(mesh);
  std::vector<std::uint32_t> face;
  bool coloured = true;
  while (lines.next()) {
    const auto& tokens = lines.tokens();
    if (tokens[0] == "v") {
      coloured = coloured && tokens.size() == 7;
      if (!coloured) continue;
      auto& colour = out.colours.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) colour[i] = number_at(tokens[4 + i], "colour", lines.place());
    } else if (tokens[0] == "vt") {
      auto& at = out.texture.emplace_back();
      for (std::size_t i = 0; i < 2 && i + 1 < tokens.size(); ++i)
        at[i] = number_at(tokens[i + 1], "texture coordinate", lines.place());
    } else if (tokens[0] == "f" || tokens[0] == "fo") {
      face.clear();
      for (std::size_t i = 1; i < tokens.size(); ++i)
        face.push_back(texture_index(tokens[i], out.texture.size(), lines.place()));
      corners.add_face(face);
    }
  }
  if (!coloured) out.colours.clear();
  if (!out.colours.empty()) require_one_per_vertex(out.colours.size(), mesh, file);
  out.texture_corners = corners.take();
  for (const auto& t : out.texture_corners) {
    for (const std::uint32_t v : t) {
      if (v != no_vertex && v >= out.texture.size()) {
        throw Error(ErrorCode::index_out_of_range,
                    fmt::format("{}: a face names texture vertex {}, but there are {}; correct the index", file, v + 1,
                                out.texture.size()));
      }
    }
  }
  return out;
}

// Which of some names a property has.
template <std::size_t n>
std::optional<std::size_t> place_in(const std::array<std::string_view, n>& names, const PlyProperty& property) {
  const auto found = std::find(names.begin(), names.end(), property.name);
  if (found == names.end() || property.is_list) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}
constexpr std::array<std::string_view, 3> colour_names{"red", "green", "blue"};
constexpr std::array<std::string_view, 6> texture_names{"s", "t", "u", "v", "texture_u", "texture_v"};

double full(PlyType type) {
  switch (type) {
    case PlyType::uint8:
      return 255;
    case PlyType::uint16:
      return 65535;
    default:
      return 1;
  }
}

class PlyAttributes {
 public:
  PlyAttributes(const PlyHeader& header, std::string_view bytes, const std::string& file, const TriangleMesh& mesh)
      : header_(header), file_(file), mesh_(mesh), body_(make_ply_body(header, bytes, file)), corners_(mesh) {}

  MeshAttributes read() {
    for (const PlyElement& element : header_.elements) {
      const bool strips = std::any_of(header_.elements.begin(), header_.elements.end(),
                                      [](const auto& e) { return e.name == "tristrips"; });
      for (std::uint64_t i = 0; i < element.count; ++i) {
        body_->begin_item(element.name, i);
        if (element.name == "vertex") {
          vertex(element);
        } else {
          face(element, element.name == "face" && !strips);
        }
        body_->end_item();
      }
    }
    if (!out_.colours.empty()) require_one_per_vertex(out_.colours.size(), mesh_, file_);
    if (by_vertex_) {
      require_one_per_vertex(out_.texture.size(), mesh_, file_);
      out_.texture_corners = mesh_.triangles;
    } else {
      out_.texture_corners = corners_.take();
    }
    return std::move(out_);
  }

 private:
  double value(PlyType type, std::string_view what) {
    const double x = body_->read_double(type, what);
    if (!std::isfinite(x)) fail_at(body_->place(), ErrorCode::non_finite, fmt::format("the {} is not finite", what));
    return x;
  }
  void skip(const PlyProperty& property) {
    body_->skip(property.type, property.is_list ? body_->read_length(property) : 1);
  }
  void vertex(const PlyElement& element) {
    std::array<double, 3> colour{};
    std::array<double, 2> at{};
    std::size_t colours = 0, places = 0;
    for (const PlyProperty& property : element.properties) {
      if (const auto channel = place_in(colour_names, property)) {
        colour[*channel] = value(property.type, "colour") / full(property.type);
        ++colours;
      } else if (const auto axis = place_in(texture_names, property)) {
        at[*axis % 2] = value(property.type, "texture coordinate");
        ++places;
      } else {
        skip(property);
      }
    }
    if (colours == 3) out_.colours.push_back(colour);
    if (places == 2) {
      if (!by_vertex_) out_.texture.clear();  // of faces that came before
      out_.texture.push_back(at);
      by_vertex_ = true;
    }
  }
  void face(const PlyElement& element, bool counts) {
    std::vector<std::uint32_t> corners;
    for (const PlyProperty& property : element.properties) {
      if (!counts || by_vertex_ || property.name != "texcoord" || !property.is_list) {
        skip(property);
        continue;
      }
      const std::uint64_t length = body_->read_length(property);
      for (std::uint64_t k = 0; k + 1 < length; k += 2) {
        corners.push_back(static_cast<std::uint32_t>(out_.texture.size()));
        const double first = value(property.type, "texture coordinate");
        out_.texture.push_back({first, value(property.type, "texture coordinate")});
      }
      if (length % 2 == 1) body_->skip(property.type, 1);
    }
    if (counts) corners_.add_face(corners);
  }

  const PlyHeader& header_;
  const std::string& file_;
  const TriangleMesh& mesh_;
  std::unique_ptr<PlyBody> body_;
  Corners corners_;
  MeshAttributes out_;
  bool by_vertex_ = false;
};

}  // namespace

MeshAttributes read_attributes(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string file = path.string(), extension = lower_case_extension(path);
  if (extension == ".obj") return of_obj(read_file_bytes(path), file, mesh);
  if (extension != ".ply") return {};
  const std::string bytes = read_file_bytes(path);
  const auto header = read_ply_header(bytes, file);
  return PlyAttributes(header, bytes, file, mesh).read();
}

}  // namespace clues::scene
