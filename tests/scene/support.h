// What the tests of scene/ share: a folder of their own, bits of doubles, and a look at the error that is thrown.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/temporary_folder.h"
#include "scene/mesh/mesh.h"
#include "scene/mesh_io.h"
#include "scene/messages/error.h"
#include "tests/read_all.h"

namespace clues::tests {

class SceneFolder : public scene::TemporaryFolder {
 public:
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path())) names.push_back(entry.path().filename());
    return names;
  }
};

inline scene::TriangleMesh mesh_of(const std::string& name, std::string_view bytes) {
  const SceneFolder folder;
  return scene::read_mesh(folder.write(name, bytes));
}

inline std::vector<std::uint64_t> bits_of(const std::vector<scene::Point>& points) {
  std::vector<std::uint64_t> bits;
  for (const auto& point : points) {
    for (const double coordinate : point) bits.push_back(std::bit_cast<std::uint64_t>(coordinate));
  }
  return bits;
}

// Appends the value's bytes in the given order.
template <class Value>
void append(std::string& bytes, Value value, std::endian order) {
  auto text = std::string(reinterpret_cast<const char*>(&value), sizeof(Value));
  if (order != std::endian::native) text = std::string(text.rbegin(), text.rend());
  bytes += text;
}

// Code and text of the Error that the call throws; fails the test if it throws none.
struct Thrown {
  scene::ErrorCode code = scene::ErrorCode::internal;
  std::string text;
};

template <class Call>
Thrown thrown_by(Call call) {
  try {
    call();
  } catch (const scene::Error& error) {
    return {error.code(), error.what()};
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

}  // namespace clues::tests
