// Fields of JSON that others may have written: a number that is not whole, negative or too large is refused, and not made
// to fit. All throw scene::JsonError, or an exception of nlohmann::json where a field is missing or of another type.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "fuzz/findings/finding.h"
#include "scene/json_reader.h"

namespace clues::fuzz {

// Runs read(); what it throws about the JSON becomes error_of(what), which is thrown in its place.
template <class Read, class ErrorOf>
auto reading_fields(const Read& read, const ErrorOf& error_of) {
  try {
    return read();
  } catch (const nlohmann::json::exception& problem) {
    throw error_of(problem.what());
  } catch (const scene::JsonError& problem) {
    throw error_of(problem.what());
  }
}

// What programs say about themselves need not be UTF-8; JSON must.
inline std::string dumped(const nlohmann::json& value, int indent = -1) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <class Number>
Number whole(const nlohmann::json& value, const std::string& what = "a number") {
  return static_cast<Number>(scene::whole_number(value, what, std::numeric_limits<Number>::max()));
}

template <class Number>
Number whole_number(const nlohmann::json& object, const std::string& key) {
  return whole<Number>(object.at(key), '"' + key + '"');
}

template <class Item, class Read>
std::array<Item, 3> three(const nlohmann::json& value, const Read& read) {
  if (!value.is_array() || value.size() != 3)
    throw scene::JsonError(0, "where three numbers are needed there are more or fewer");
  return {read(value[0]), read(value[1]), read(value[2])};
}

inline std::array<std::string, 3> three_texts(const nlohmann::json& value) {
  return three<std::string>(value, [](const nlohmann::json& x) { return x.get<std::string>(); });
}

// Whole numbers by name; none where the field is missing.
inline std::map<std::string, std::int64_t> numbers_by_name(const nlohmann::json& object, const std::string& key) {
  std::map<std::string, std::int64_t> out;
  const auto found = object.find(key);
  if (found == object.end()) return out;
  if (!found->is_object()) throw scene::JsonError(0, '"' + key + "\" is no object");
  for (const auto& [name, value] : found->items()) {
    if (!value.is_number_integer()) throw scene::JsonError(0, "in \"" + key + "\" is a number that is not whole");
    out[name] = value.get<std::int64_t>();
  }
  return out;
}

// The flags of a scene (D22), a digit a triangle; an object without fields where all triangles block and count.
inline nlohmann::json flags_json(const Case& scene) {
  nlohmann::json out = nlohmann::json::object();
  const auto put = [&](const char* name, const std::vector<std::uint8_t>& flags) {
    if (flags.empty()) return;
    std::string digits;
    for (const auto flag : flags) digits += flag != 0 ? '1' : '0';
    out[name] = digits;
  };
  put("blocks", scene.blocks);
  put("counts", scene.counts);
  return out;
}

inline void take_flags(const nlohmann::json& flags, Case& scene) {
  if (!flags.is_object()) throw scene::JsonError(0, "\"flags\" is no object");
  for (const auto& [name, value] : flags.items()) {
    if (name != "blocks" && name != "counts") throw scene::JsonError(0, "\"flags\" has a field that it cannot have");
    auto& out = name == "blocks" ? scene.blocks : scene.counts;
    for (const char digit : value.get<std::string>()) {
      if (digit != '0' && digit != '1') throw scene::JsonError(0, "a flag is neither 0 nor 1");
      out.push_back(digit == '1' ? 1 : 0);
    }
  }
}

}  // namespace clues::fuzz
