// A list of triangles as one bit a triangle (triangle t is bit t % 8 of byte t / 8), packed by zstd.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace clues::scene {

// Any bytes, packed by zstd.
std::string packed_bytes(const std::string& bytes);

// `list` ascending, below `triangles`. The same bytes for the same list.
std::string packed_list(const std::vector<std::uint32_t>& list, std::uint32_t triangles);

// Throws Error malformed with `where` in front of anything but such bytes.
std::vector<std::uint32_t> unpacked_list(const std::string& bytes, std::uint32_t triangles, const std::string& where);

}  // namespace clues::scene
