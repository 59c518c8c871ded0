// Fields of a glTF document, strictly: what is there has the type that the format says, or the file is refused. A reader that takes a misspelt
// index for none would draw something else than the author did.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/formats/place.h"

namespace clues::scene {

using Json = nlohmann::json;

// An object of the document and where it is: "FILE: accessor 3".
struct GltfObject {
  const Json* json = nullptr;
  Place place;

  [[noreturn]] void fail(const std::string& what) const;  // malformed

  const Json* find(const char* key) const;  // null: absent
  std::optional<std::uint64_t> whole(const char* key, std::uint64_t most) const;
  std::uint64_t needed_whole(const char* key, std::uint64_t most) const;
  std::optional<std::uint32_t> index(const char* key, const char* what,
                                     std::size_t count) const;  // throws index_out_of_range
  std::uint32_t needed_index(const char* key, const char* what, std::size_t count) const;
  std::vector<std::uint32_t> indices(const char* key, const char* what, std::size_t count) const;
  std::string text(const char* key, const char* otherwise) const;
  bool flag(const char* key) const;  // false when absent
  std::optional<std::vector<double>> numbers(const char* key, std::size_t count) const;
  std::optional<GltfObject> object(const char* key) const;
  std::vector<GltfObject> objects(const char* key,
                                  std::string_view item) const;  // empty when absent; `item` must outlive them
  bool has_extension(std::string_view name) const;
};

}  // namespace clues::scene
