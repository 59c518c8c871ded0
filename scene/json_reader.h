// The one way from bytes to JSON values, for files, replies and reports alike. Stricter than JSON has to be, because whoever wrote the bytes is
// not trusted: no nesting without end, no object with a key twice (readers differ about which one counts), nothing after the end, no NUL.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clues::scene {

struct JsonLimits {
  std::size_t bytes = std::size_t{1} << 30;
  std::size_t depth = 32;  // lists and objects within each other
};

// what() is one printable line: what is wrong. `line` counts from 1; 0: the text as a whole.
class JsonError : public std::runtime_error {
 public:
  JsonError(std::uint64_t line, const std::string& what) : std::runtime_error(what), line_(line) {}
  std::uint64_t line() const noexcept { return line_; }

 private:
  std::uint64_t line_;
};

// Throws JsonError.
nlohmann::json parse_json_text(std::string_view text, const JsonLimits& limits = {});

// `file` is for messages only. Throws Error malformed, "FILE:LINE: what".
nlohmann::json parse_json(std::string_view text, const std::string& file, const JsonLimits& limits = {});

// Throws as read_file_bytes, and as parse_json.
nlohmann::json read_json_file(const std::filesystem::path& path, const JsonLimits& limits = {});

// A value as a whole number from 0 to `most`; 1.0, 1e2, -1 and "1" are none. Throws JsonError that begins with `what`: "the field \"seed\"".
std::uint64_t whole_number(const nlohmann::json& value, std::string_view what,
                           std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

// A value for a message: shortened, and never deeper than its first level.
std::string json_excerpt(const nlohmann::json& value);

}  // namespace clues::scene
