// A glTF document that a test puts together: JSON, and one buffer that is written into a data URI, a file beside it, or a .glb file.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"

namespace clues::tests {

struct MadeGltf {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  // Each returns the index of what it adds.
  std::size_t add(const char* list, nlohmann::json object);
  std::size_t add_view(const std::string& bytes, std::size_t stride = 0);
  std::size_t add_positions(const std::vector<scene::Point>& points);  // of floats
  std::size_t add_indices(const std::vector<std::uint32_t>& indices, int component = 5125);
  std::size_t add_mesh(nlohmann::json primitive, const std::string& name = "");
  std::size_t add_node(std::size_t mesh, nlohmann::json more = nlohmann::json::object());

  std::string text() const;  // with a data URI
  std::string glb() const;
};

// A .glb file of a JSON document and what its first buffer has, if that has no URI.
std::string glb_of(const std::string& document, const std::string& buffer);
std::string base64(const std::string& bytes);
std::string floats(const std::vector<double>& values);
std::string numbers(const std::vector<std::uint32_t>& values, int component);

// One node with one triangle (0, 0, 0), (1, 0, 0), (0, 1, 0).
MadeGltf one_triangle();

}  // namespace clues::tests
