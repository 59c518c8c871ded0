// D1: which scene a result, a list or a store is about, and whether a file is still that scene.
#pragma once

#include <filesystem>
#include <string>

namespace clues::scene {

// 64 hex digits: the SHA-256 of the file, or, for a .gltf whose buffers are files of their own, of the text that has a line with the SHA-256 of each file: of the .gltf, then of
// those of "buffers" in their order ("missing" where there is none: what only textures use is never read). Throws Error: file_not_found, file_unreadable, and for a
// .gltf what read_gltf throws. O(size of the files).
std::string sha256_of_scene(const std::filesystem::path& path);

}  // namespace clues::scene
