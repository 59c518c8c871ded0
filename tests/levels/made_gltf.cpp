#include "tests/levels/made_gltf.h"

#include <bit>

namespace clues::tests {
namespace {

void append(std::string& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

std::string padded(std::string bytes, char with) {
  bytes.append((4 - bytes.size() % 4) % 4, with);
  return bytes;
}

}  // namespace

std::string base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string floats(const std::vector<double>& values) {
  std::string bytes;
  for (const double x : values) append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4);
  return bytes;
}

std::string numbers(const std::vector<std::uint32_t>& values, int component) {
  std::string bytes;
  for (const auto x : values) append(bytes, x, component == 5121 ? 1 : component == 5123 ? 2 : 4);
  return bytes;
}

std::size_t MadeGltf::add(const char* list, nlohmann::json object) {
  json[list].push_back(std::move(object));
  return json[list].size() - 1;
}

std::size_t MadeGltf::add_view(const std::string& bytes, std::size_t stride) {
  buffer = padded(buffer, '\0');
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  buffer += bytes;
  return add("bufferViews", view);
}

std::size_t MadeGltf::add_positions(const std::vector<scene::Point>& points) {
  std::vector<double> values;
  for (const auto& p : points) values.insert(values.end(), p.begin(), p.end());
  return add(
      "accessors",
      {{"bufferView", add_view(floats(values))}, {"componentType", 5126}, {"count", points.size()}, {"type", "VEC3"}});
}

std::size_t MadeGltf::add_indices(const std::vector<std::uint32_t>& indices, int component) {
  return add("accessors", {{"bufferView", add_view(numbers(indices, component))},
                           {"componentType", component},
                           {"count", indices.size()},
                           {"type", "SCALAR"}});
}

std::size_t MadeGltf::add_mesh(nlohmann::json primitive, const std::string& name) {
  nlohmann::json mesh = {{"primitives", nlohmann::json::array({std::move(primitive)})}};
  if (!name.empty()) mesh["name"] = name;
  return add("meshes", mesh);
}

std::size_t MadeGltf::add_node(std::size_t mesh, nlohmann::json more) {
  more["mesh"] = mesh;
  return add("nodes", std::move(more));
}

std::string MadeGltf::text() const {
  nlohmann::json out = json;
  out["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
  return out.dump();
}

std::string MadeGltf::glb() const {
  nlohmann::json out = json;
  out["buffers"] = {{{"byteLength", buffer.size()}}};
  return glb_of(out.dump(), buffer);
}

std::string glb_of(const std::string& document, const std::string& buffer) {
  const std::string text = padded(document, ' '), binary = padded(buffer, '\0');
  std::string bytes = "glTF";
  append(bytes, 2, 4);
  append(bytes, static_cast<std::uint32_t>(28 + text.size() + binary.size()), 4);
  append(bytes, static_cast<std::uint32_t>(text.size()), 4);
  bytes += "JSON" + text;
  append(bytes, static_cast<std::uint32_t>(binary.size()), 4);
  return bytes + std::string("BIN\0", 4) + binary;
}

MadeGltf one_triangle() {
  MadeGltf made;
  const auto position = made.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  made.add_node(made.add_mesh({{"attributes", {{"POSITION", position}}}}));
  return made;
}

}  // namespace clues::tests
