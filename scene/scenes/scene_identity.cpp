#include "scene/scenes/scene_identity.h"

#include <vector>

#include "scene/formats/file_bytes.h"
#include "scene/gltf/gltf_document.h"
#include "scene/mesh_io.h"
#include "scene/result.h"

namespace clues::scene {

std::string sha256_of_scene(const std::filesystem::path& path) {
  const std::string bytes = read_file_bytes(path), file = path.string();
  if (const std::string kind = lower_case_extension(path); kind != ".gltf" && kind != ".glb") return sha256_of(bytes);
  const auto buffers = GltfDocument(bytes, file, {}).files_of_buffers();
  if (buffers.empty()) return sha256_of(bytes);
  std::string lines = sha256_of(bytes) + '\n';
  for (const std::string& buffer : buffers) {
    const auto place = path.parent_path() / buffer;
    std::error_code error;
    lines += (std::filesystem::exists(place, error) ? sha256_of_file(place) : "missing") + '\n';
  }
  return sha256_of(lines);
}

}  // namespace clues::scene
