#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace clues::tests {

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace clues::tests
