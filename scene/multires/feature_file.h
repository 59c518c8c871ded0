// Features as a text: two vertex numbers a line for an edge, one for a vertex that stays; '#' starts a comment.
#pragma once

#include <filesystem>
#include <vector>

#include "scene/multires/hierarchy.h"

namespace clues::scene {

struct Features {
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertices;
};

// Throws Error as read_file_bytes, malformed with the line. Whether the numbers exist is not asked.
Features read_features(const std::filesystem::path& path);

}  // namespace clues::scene
