// A glTF 2.0 document: the JSON, and the bytes of its buffers, from a .gltf file with files or data URIs beside it, or from a .glb file.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_fields.h"

namespace clues::scene {

// Bytes of the file that a buffer's URI names, relative to the document. Throws Error.
using BufferLoader = std::function<std::string(const std::string& relative_path)>;

class GltfDocument {
 public:
  // Throws Error: malformed, unsupported (glTF 1, extensions that are required and change the geometry). `file` must outlive it.
  GltfDocument(std::string_view bytes, const std::string& file, const BufferLoader& load);

  const GltfObject& root() const { return root_; }
  const std::vector<GltfObject>& nodes() const { return nodes_; }
  const std::vector<GltfObject>& meshes() const { return meshes_; }
  const std::vector<GltfObject>& materials() const { return materials_; }
  const std::vector<GltfObject>& accessors() const { return accessors_; }
  const std::vector<GltfObject>& buffer_views() const { return buffer_views_; }
  const std::vector<GltfObject>& buffers() const { return buffers_; }
  // Read when it is first asked for: what only textures use is never read.
  std::string_view bytes_of_buffer(std::uint32_t buffer);
  // Those of all buffers that are files of their own and may be read, relative, in the order of "buffers"; whether they exist is not asked.
  std::vector<std::string> files_of_buffers() const;

 private:
  std::string_view take_chunks(std::string_view bytes);
  void check_extensions() const;

  const std::string& file_;
  BufferLoader load_;
  bool is_binary_ = false;
  std::string_view chunk_;  // BIN
  Json json_;
  GltfObject root_;
  std::vector<GltfObject> nodes_, meshes_, materials_, accessors_, buffer_views_, buffers_;
  std::vector<std::string> loaded_;
  std::vector<bool> is_loaded_;
};

}  // namespace clues::scene
