// Visible fragments as binary glTF 2.0. That format has single floats only: corners are written relative to the middle of
// all, which stands as a translation in the node, and are each rounded once; neighbours name the same corner, so there is
// no crack. Which triangles are whose stands in "extras" of the mesh: [id, 0 front or 1 back, how many].
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/mesh/bounds.h"
#include "scene/messages/error.h"
#include "scene/stream/varints.h"
#include "validate/stream/fragments_file.h"

namespace clues::validate {
namespace {

using nlohmann::json;

constexpr std::uint32_t array_buffer = 34962, element_array_buffer = 34963, floats = 5126, unsigned_ints = 5125;

// Its length, its kind, and its bytes, padded to whole words.
void put_chunk(std::string bytes, const char* kind, char padding, scene::VarintWriter& out) {
  while (bytes.size() % 4 != 0) bytes.push_back(padding);
  out.raw(bytes.size(), 4);
  out.bytes.append(kind, 4).append(bytes);
}

scene::Point middle_of(const std::vector<scene::Point>& points) {
  const auto box = scene::bounds_of(points);
  scene::Point middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = box.low[i] / 2 + box.high[i] / 2;
  return middle;
}

float single(double x) {
  if (!(std::abs(x) <= std::numeric_limits<float>::max()))
    throw scene::Error(
        scene::ErrorCode::unsupported,
        fmt::format("fragments: {:.3g} is too large for glTF, which has single floats; write *.obj, *.ply "
                    "or *.json",
                    x));
  return static_cast<float>(x);
}

json groups_of(const std::vector<FileFragment>& fragments) {
  json groups = json::array();
  for (std::size_t i = 0, end = 0; i < fragments.size(); i = end) {
    const auto& f = fragments[i];
    while (end < fragments.size() && fragments[end].triangle == f.triangle && fragments[end].front == f.front) ++end;
    groups.push_back({f.triangle, f.front ? 0 : 1, end - i});
  }
  return groups;
}

// The buffer, and what the document says of it.
void put_mesh(const FragmentsRecord& mesh, const scene::Point& middle, json& document, scene::VarintWriter& binary) {
  constexpr float most = std::numeric_limits<float>::max();
  std::array<float, 3> low{most, most, most}, high{-most, -most, -most};
  for (const scene::Point& p : mesh.rounded) {
    for (std::size_t i = 0; i < 3; ++i) {
      const float x = single(p[i] - middle[i]);
      low[i] = std::min(low[i], x);
      high[i] = std::max(high[i], x);
      binary.raw(std::bit_cast<std::uint32_t>(x), 4);
    }
  }
  const std::size_t corners = binary.bytes.size();
  for (const FileFragment& f : mesh.fragments) {
    for (const std::uint64_t corner : f.corners) binary.raw(corner, 4);
  }
  const json primitive{{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
  document["meshes"] =
      json::array({{{"primitives", {primitive}}, {"extras", {{"fragments", groups_of(mesh.fragments)}}}}});
  document["buffers"] = json::array({{{"byteLength", binary.bytes.size()}}});
  document["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", corners}, {"target", array_buffer}},
                                         {{"buffer", 0},
                                          {"byteOffset", corners},
                                          {"byteLength", binary.bytes.size() - corners},
                                          {"target", element_array_buffer}}});
  document["accessors"] = json::array({{{"bufferView", 0},
                                        {"componentType", floats},
                                        {"count", mesh.rounded.size()},
                                        {"type", "VEC3"},
                                        {"min", low},
                                        {"max", high}},
                                       {{"bufferView", 1},
                                        {"componentType", unsigned_ints},
                                        {"count", 3 * mesh.fragments.size()},
                                        {"type", "SCALAR"}}});
}

}  // namespace

std::string to_glb_bytes(const FragmentsRecord& mesh) {
  json document{{"asset", {{"version", "2.0"}, {"generator", "clues"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
  json node{{"name", "visible fragments of " + mesh.scene_file}};
  scene::VarintWriter binary, chunks, out;
  if (!mesh.fragments.empty()) {  // glTF has no mesh without triangles
    const scene::Point middle = middle_of(mesh.rounded);
    node["mesh"] = 0;
    node["translation"] = middle;
    put_mesh(mesh, middle, document, binary);
  }
  document["nodes"] = json::array({std::move(node)});
  put_chunk(document.dump(-1, ' ', false, json::error_handler_t::replace), "JSON", ' ', chunks);
  if (!binary.bytes.empty()) put_chunk(std::move(binary.bytes), "BIN\0", '\0', chunks);
  if (chunks.bytes.size() > std::numeric_limits<std::uint32_t>::max() - 12)
    throw scene::Error(scene::ErrorCode::unsupported, "fragments: more than 4 GiB, which is too long for binary glTF");
  out.bytes = "glTF";
  out.raw(2, 4);
  out.raw(12 + chunks.bytes.size(), 4);
  return out.bytes + chunks.bytes;
}

}  // namespace clues::validate
