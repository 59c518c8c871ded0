#include "app/maps/remesh_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "app/maps/patch_colours.h"
#include "app/view/base64.h"
#include "scene/mesh/bounds.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "scene/ply_text.h"

namespace clues::app {
namespace {

using Attributes = scene::MeshAttributes;

bool has_texture(const Attributes& attributes, std::size_t t) {
  return !attributes.texture_corners.empty() && attributes.texture_corners[t][0] != scene::no_vertex;
}

std::string to_obj(const reference::Remesh& remesh, const Attributes& attributes) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  for (std::size_t v = 0; v < remesh.mesh.points.size(); ++v) {
    const auto& p = remesh.mesh.points[v];
    fmt::format_to(to, "v {} {} {}", p[0], p[1], p[2]);
    if (!attributes.colours.empty()) {
      const auto& c = attributes.colours[v];
      fmt::format_to(to, " {} {} {}", c[0], c[1], c[2]);
    }
    out.push_back('\n');
  }
  for (const auto& at : attributes.texture) fmt::format_to(to, "vt {} {}\n", at[0], at[1]);
  for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
    out.push_back('f');
    for (std::size_t k = 0; k < 3; ++k) {
      fmt::format_to(to, " {}", remesh.mesh.triangles[t][k] + 1);
      if (has_texture(attributes, t)) fmt::format_to(to, "/{}", attributes.texture_corners[t][k] + 1);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

std::string to_ply(const reference::Remesh& remesh, const Attributes& attributes) {
  const bool coloured = !attributes.colours.empty(), textured = !attributes.texture_corners.empty();
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  fmt::format_to(to,
                 "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                 "{}element face {}\nproperty list uchar int vertex_indices\n{}{}end_header\n",
                 remesh.mesh.points.size(), coloured ? scene::ply_colour : "", remesh.mesh.triangles.size(),
                 coloured ? "" : scene::ply_colour, textured ? "property list uchar double texcoord\n" : "");
  for (std::size_t v = 0; v < remesh.mesh.points.size(); ++v) {
    const auto& p = remesh.mesh.points[v];
    fmt::format_to(to, "{} {} {}", p[0], p[1], p[2]);
    if (coloured) {
      for (const double c : attributes.colours[v])
        fmt::format_to(to, " {}", std::lround(255 * std::clamp(c, 0.0, 1.0)));
    }
    out.push_back('\n');
  }
  for (std::size_t k = 0; k < remesh.base.size(); ++k) {
    const auto& t = remesh.mesh.triangles[k];
    fmt::format_to(to, "3 {} {} {}", t[0], t[1], t[2]);
    if (!coloured) {
      const auto patch = patch_colour(remesh.base[k]);
      fmt::format_to(to, " {} {} {}", patch[0], patch[1], patch[2]);
    }
    if (has_texture(attributes, k)) {
      fmt::format_to(to, " 6");
      for (const std::uint32_t c : attributes.texture_corners[k])
        fmt::format_to(to, " {} {}", attributes.texture[c][0], attributes.texture[c][1]);
    } else if (textured) {
      fmt::format_to(to, " 0");
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

void require_float(double x) {
  if (std::abs(x) <= std::numeric_limits<float>::max()) return;
  throw scene::Error(scene::ErrorCode::unsupported,
                     "--remesh: glTF has floats, and coordinates are too large for them; write another format");
}

// One mesh of one primitive; a buffer of floats, and indices at its end.
class GltfWriter {
 public:
  GltfWriter(const reference::Remesh& remesh, const Attributes& attributes) : remesh_(remesh), attributes_(attributes) {
    // A corner without texture coordinates gets those at 0.
    const bool textured = !attributes.texture_corners.empty();
    for (std::size_t t = 0; t < remesh.mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const scene::Edge corner{remesh.mesh.triangles[t][k],
                                 textured ? attributes.texture_corners[t][k] : scene::no_vertex};
        const auto [place, fresh] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(vertices_.size()));
        if (fresh) vertices_.push_back(corner);
        indices_.push_back(place->second);
      }
    }
  }

  std::string binary() {
    write();
    while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
    document_["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string json = document_.dump();
    while (json.size() % 4 != 0) json.push_back(' ');
    std::string out;
    const auto word = [&](std::size_t x) {
      if (x > std::numeric_limits<std::uint32_t>::max())
        throw scene::Error(scene::ErrorCode::unsupported, "--remesh: a .glb has at most 4 GiB; write another format");
      for (const char byte : std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(x))) out.push_back(byte);
    };
    out += "glTF";
    word(2);
    word(12 + 8 + json.size() + 8 + bytes_.size());
    word(json.size());
    out += "JSON";
    out += json;
    word(bytes_.size());
    out.append("BIN\0", 4);
    return out + bytes_;
  }
  std::string text() {
    write();
    Base64 encoded;
    for (const char byte : bytes_) encoded.put(byte);
    document_["buffers"] = {
        {{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + encoded.take()}}};
    return document_.dump(1) + "\n";
  }

 private:
  static_assert(std::endian::native == std::endian::little);
  template <class Number>
  void put(Number x) {
    for (const char byte : std::bit_cast<std::array<char, sizeof(Number)>>(x)) bytes_.push_back(byte);
  }
  // A buffer view from `begin` to the end, and an accessor on it.
  nlohmann::json& accessor(std::size_t begin, int target, int component, std::size_t count, const char* type) {
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}, {"target", target}});
    document_["accessors"].push_back({{"bufferView", document_["bufferViews"].size() - 1},
                                      {"componentType", component},
                                      {"count", count},
                                      {"type", type}});
    return document_["accessors"].back();
  }
  template <class Value>
  nlohmann::json& floats(std::size_t width, const Value& value_of) {
    const std::size_t begin = bytes_.size();
    for (const auto& vertex : vertices_) {
      for (std::size_t i = 0; i < width; ++i) {
        const double value = value_of(vertex, i);
        require_float(value);
        put(static_cast<float>(value));
      }
    }
    return accessor(begin, 34962, 5126, vertices_.size(), width == 3 ? "VEC3" : "VEC2");
  }
  void write() {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "clues maps"}}},
                 {"scene", 0},
                 {"scenes", {{{"nodes", {0}}}}},
                 {"nodes", {{{"mesh", 0}}}}};
    const auto [low, high] = scene::bounds_of(remesh_.mesh.points);
    auto& places = floats(3, [&](const scene::Edge& v, std::size_t i) { return remesh_.mesh.points[v[0]][i]; });
    places["min"] = low;
    places["max"] = high;
    nlohmann::json names{{"POSITION", 0}};
    if (!attributes_.texture_corners.empty()) {
      floats(2, [&](const scene::Edge& v, std::size_t i) {
        if (v[1] == scene::no_vertex) return 0.0;
        const double at = attributes_.texture[v[1]][i];
        return i == 1 ? 1 - at : at;
      });
      names["TEXCOORD_0"] = document_["accessors"].size() - 1;
    }
    if (!attributes_.colours.empty()) {
      floats(3,
             [&](const scene::Edge& v, std::size_t i) { return std::clamp(attributes_.colours[v[0]][i], 0.0, 1.0); });
      names["COLOR_0"] = document_["accessors"].size() - 1;
    }
    const std::size_t begin = bytes_.size();
    for (const std::uint32_t index : indices_) put(index);
    accessor(begin, 34963, 5125, indices_.size(), "SCALAR");
    document_["meshes"] = {{{"primitives", {{{"attributes", names}, {"indices", document_["accessors"].size() - 1}}}}}};
  }

  const reference::Remesh& remesh_;
  const Attributes& attributes_;
  std::map<scene::Edge, std::uint32_t> numbers_;  // not ascending: vertex, texture
  std::vector<scene::Edge> vertices_;
  std::vector<std::uint32_t> indices_;
  std::string bytes_;
  nlohmann::json document_;
};

}  // namespace

void require_remesh_format(const std::string& file) {
  const std::string extension = scene::lower_case_extension(file);
  for (const char* known : {".ply", ".obj", ".off", ".glb", ".gltf"}) {
    if (extension == known) return;
  }
  throw scene::Error(scene::ErrorCode::unsupported,
                     fmt::format("--remesh {}: meshes are written as .ply, .obj, .off, .glb or .gltf", file));
}

bool is_of_floats(const std::string& file) {
  const std::string extension = scene::lower_case_extension(file);
  return extension == ".glb" || extension == ".gltf";
}

void require_floats(const scene::TriangleMesh& mesh) {
  for (const auto& p : mesh.points) {
    for (const double x : p) require_float(x);
  }
}

std::string remesh_to_file(const reference::Remesh& remesh, const Attributes& attributes, const std::string& file) {
  const std::string extension = scene::lower_case_extension(file);
  if (extension == ".off") return scene::to_off_text(remesh.mesh);
  if (extension == ".obj") return to_obj(remesh, attributes);
  if (extension == ".glb") return GltfWriter(remesh, attributes).binary();
  if (extension == ".gltf") return GltfWriter(remesh, attributes).text();
  return to_ply(remesh, attributes);
}

}  // namespace clues::app
