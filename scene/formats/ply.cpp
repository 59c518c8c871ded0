// D1 from PLY: x, y, z of the element "vertex", and the index lists of the elements "face" and "tristrips"; the rest is skipped.
#include <algorithm>
#include <array>
#include <optional>

#include "scene/formats/mesh_builder.h"
#include "scene/formats/ply_body.h"
#include "scene/formats/ply_header.h"
#include "scene/formats/readers.h"

namespace clues::scene {
namespace {

bool is_index_list(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

bool is_faces(const PlyElement& element) { return element.name == "face" || element.name == "tristrips"; }

// 0, 1, 2 for x, y, z.
std::optional<std::size_t> axis_of(const PlyProperty& property) {
  if (property.name.size() != 1 || property.name[0] < 'x' || property.name[0] > 'z') return std::nullopt;
  return static_cast<std::size_t>(property.name[0] - 'x');
}

void check_vertex_element(const PlyElement& element, const std::string& file) {
  for (const char* name : {"x", "y", "z"}) {
    const auto fits = [&](const PlyProperty& property) { return property.name == name && !property.is_list; };
    const auto named = [&](const PlyProperty& property) { return property.name == name; };
    const auto& properties = element.properties;
    if (std::count_if(properties.begin(), properties.end(), fits) != 1 ||
        std::count_if(properties.begin(), properties.end(), named) != 1) {
      fail_in(file, ErrorCode::malformed,
              std::string("the element 'vertex' must have one number ") + name + "; add: property double " + name);
    }
  }
}

void check_face_element(const PlyElement& element, const std::string& file) {
  const auto& properties = element.properties;
  if (std::count_if(properties.begin(), properties.end(), is_index_list) != 1) {
    fail_in(file, ErrorCode::malformed,
            "the element " + excerpt(element.name) + " must have one list vertex_indices; export it again");
  }
  const auto& indices = *std::find_if(properties.begin(), properties.end(), is_index_list);
  if (!indices.is_list || !is_integer(indices.type)) {
    fail_in(file, ErrorCode::malformed, excerpt(indices.name) + " must be a list of whole numbers; export it again");
  }
}

void check_header(const PlyHeader& header, const std::string& file) {
  bool has_vertices = false;
  for (const auto& element : header.elements) {
    if (element.name == "vertex") {
      check_vertex_element(element, file);
      has_vertices = true;
    } else if (is_faces(element) && element.count > 0) {
      check_face_element(element, file);
    }
  }
  if (!has_vertices) fail_in(file, ErrorCode::malformed, "there is no element 'vertex'; export it again");
}

void skip_property(const PlyProperty& property, PlyBody& body) {
  const std::uint64_t count = property.is_list ? body.read_length(property) : 1;
  body.skip(property.type, count);
}

void read_vertices(const PlyElement& element, PlyBody& body, MeshBuilder& builder) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_item(element.name, i);
    Point point{};
    for (const auto& property : element.properties) {
      if (const auto axis = axis_of(property)) {
        point[*axis] = body.read_double(property.type, "coordinate");
      } else {
        skip_property(property, body);
      }
    }
    body.end_item();
    builder.add_point(point, body.place());
  }
}

// Each corner makes a triangle with the two before it, every other one turned round so that all face the same way; -1 begins anew.
void add_strip(const std::vector<std::int64_t>& corners, const Place& place, MeshBuilder& builder) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) first = i + 1;
    if (i < first + 2 || corners[i] == -1) continue;
    const bool turned = (i - first) % 2 == 1;
    builder.add_face(std::array{corners[turned ? i - 1 : i - 2], corners[turned ? i - 2 : i - 1], corners[i]}, place);
  }
}

void read_faces(const PlyElement& element, PlyBody& body, MeshBuilder& builder) {
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_item(element.name, i);
    for (const auto& property : element.properties) {
      if (!is_index_list(property)) {
        skip_property(property, body);
        continue;
      }
      corners.resize(body.read_length(property));
      for (auto& corner : corners) corner = body.read_integer(property.type, "vertex index");
    }
    body.end_item();
    if (element.name == "tristrips") {
      add_strip(corners, body.place(), builder);
    } else {
      builder.add_face(corners, body.place());
    }
  }
}

void skip_element(const PlyElement& element, PlyBody& body) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin_item(element.name, i);
    for (const auto& property : element.properties) skip_property(property, body);
    body.end_item();
  }
}

}  // namespace

TriangleMesh read_ply(std::string_view bytes, const std::string& file) {
  const auto header = read_ply_header(bytes, file);
  check_header(header, file);
  const auto body = make_ply_body(header, bytes, file);
  MeshBuilder builder(file, 0);
  for (const auto& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, *body, builder);
    } else if (is_faces(element)) {
      read_faces(element, *body, builder);
    } else {
      skip_element(element, *body);
    }
  }
  body->finish();
  return builder.take();
}

}  // namespace clues::scene
