#include "scene/gltf/gltf_fields.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scene/json_reader.h"

namespace clues::scene {
namespace {

constexpr std::uint64_t most_whole = std::uint64_t{1} << 53;

}  // namespace

void GltfObject::fail(const std::string& what) const {
  fail_at(place, ErrorCode::malformed, what + "; export the file again");
}

const Json* GltfObject::find(const char* key) const {
  const auto found = json->find(key);
  return found == json->end() ? nullptr : &*found;
}

std::optional<std::uint64_t> GltfObject::whole(const char* key, std::uint64_t most) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  const bool small = value->is_number_unsigned() && value->get<std::uint64_t>() <= std::min(most, most_whole);
  if (!small) fail(fmt::format("\"{}\" is {}, and no whole number from 0 to {}", key, json_excerpt(*value), most));
  return value->get<std::uint64_t>();
}

std::uint64_t GltfObject::needed_whole(const char* key, std::uint64_t most) const {
  const auto value = whole(key, most);
  if (!value) fail(fmt::format("\"{}\" is missing", key));
  return *value;
}

std::optional<std::uint32_t> GltfObject::index(const char* key, const char* what, std::size_t count) const {
  const auto value = whole(key, std::numeric_limits<std::uint32_t>::max());
  if (!value) return std::nullopt;
  if (*value >= count) {
    fail_at(place, ErrorCode::index_out_of_range,
            fmt::format("{} {} does not exist: the file has {}; export the file again", what, *value, count));
  }
  return static_cast<std::uint32_t>(*value);
}

std::uint32_t GltfObject::needed_index(const char* key, const char* what, std::size_t count) const {
  const auto value = index(key, what, count);
  if (!value) fail(fmt::format("\"{}\" is missing", key));
  return *value;
}

std::vector<std::uint32_t> GltfObject::indices(const char* key, const char* what, std::size_t count) const {
  const Json* list = find(key);
  if (list == nullptr) return {};
  if (!list->is_array()) fail(fmt::format("\"{}\" is no list", key));
  std::vector<std::uint32_t> found;
  for (const Json& value : *list) {
    if (!value.is_number_unsigned())
      fail(fmt::format("\"{}\" holds {}, which is no {}", key, json_excerpt(value), what));
    if (value.get<std::uint64_t>() >= count) {
      fail_at(place, ErrorCode::index_out_of_range,
              fmt::format("{} {} does not exist: the file has {}; export the file again", what,
                          value.get<std::uint64_t>(), count));
    }
    found.push_back(value.get<std::uint32_t>());
  }
  return found;
}

std::string GltfObject::text(const char* key, const char* otherwise) const {
  const Json* value = find(key);
  if (value == nullptr) return otherwise;
  if (!value->is_string()) fail(fmt::format("\"{}\" is {}, and no text", key, json_excerpt(*value)));
  return value->get<std::string>();
}

bool GltfObject::flag(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) fail(fmt::format("\"{}\" is {}, and neither true nor false", key, json_excerpt(*value)));
  return value->get<bool>();
}

std::optional<std::vector<double>> GltfObject::numbers(const char* key, std::size_t count) const {
  const Json* list = find(key);
  if (list == nullptr) return std::nullopt;
  if (!list->is_array() || list->size() != count) fail(fmt::format("\"{}\" is no list of {} numbers", key, count));
  std::vector<double> found;
  for (const Json& value : *list) {
    if (!value.is_number()) fail(fmt::format("\"{}\" holds {}, which is no number", key, json_excerpt(value)));
    found.push_back(value.get<double>());
    if (!std::isfinite(found.back()))
      fail_at(place, ErrorCode::non_finite,
              fmt::format("\"{}\" holds what is no finite number; export the file again", key));
  }
  return found;
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_object()) fail(fmt::format("\"{}\" is {}, and no object", key, json_excerpt(*value)));
  return GltfObject{value, place};
}

std::vector<GltfObject> GltfObject::objects(const char* key, std::string_view item) const {
  const Json* list = find(key);
  if (list == nullptr) return {};
  if (!list->is_array()) fail(fmt::format("\"{}\" is no list", key));
  std::vector<GltfObject> found;
  for (const Json& value : *list) {
    found.push_back({&value, {place.file, item, found.size()}});
    if (!value.is_object()) found.back().fail("is no object");
  }
  return found;
}

bool GltfObject::has_extension(std::string_view name) const {
  const auto extensions = object("extensions");
  return extensions && extensions->json->contains(std::string(name));
}

}  // namespace clues::scene
