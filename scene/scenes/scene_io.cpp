#include "scene/scenes/scene_io.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "scene/formats/file_bytes.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/levels/bsp_scene.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"

namespace clues::scene {

std::optional<BspFile> read_level(const std::filesystem::path& path) {
  if (lower_case_extension(path) != ".bsp") return std::nullopt;
  return parse_bsp(read_file_bytes(path), path.string());
}

FlaggedMesh read_scene(const std::filesystem::path& path) {
  if (const auto level = read_level(path)) return scene_of_level(*level).scene;
  const std::string extension = lower_case_extension(path), file = path.string();
  if (extension != ".gltf" && extension != ".glb") {
    FlaggedMesh scene;
    scene.mesh = read_mesh(path);
    return scene;
  }
  auto scene = read_gltf(read_file_bytes(path), file,
                         [&](const std::string& relative) { return read_file_bytes(path.parent_path() / relative); });
  require_triangles(scene.mesh, path);
  return scene;
}

TriangleMesh read_plain_scene(const std::filesystem::path& path) {
  auto scene = read_scene(path);
  if (scene.is_plain()) return std::move(scene.mesh);
  const auto without = [](const std::vector<std::uint8_t>& flags) { return std::count(flags.begin(), flags.end(), 0); };
  throw Error(ErrorCode::unsupported, fmt::format("{}: {} triangles do not block and {} do not count (glass, curves, "
                                                  "hulls); `clues map`, check, bake, query and verify take such scenes",
                                                  path.string(), without(scene.blocks), without(scene.counts)));
}

TriangleMesh read_drawn_scene(const std::filesystem::path& path) {
  auto scene = read_scene(path);
  if (scene.counts.empty()) return std::move(scene.mesh);
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (scene.counting(t)) ids.push_back(t);
  }
  return part_of(scene.mesh, ids);
}

}  // namespace clues::scene
