// nlohmann-json reads by events, which takes no stack whatever the text says; the values are put together here.
#include "scene/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "scene/formats/file_bytes.h"
#include "scene/formats/place.h"
#include "scene/messages/printable.h"

namespace clues::scene {
namespace {

using Json = nlohmann::json;

constexpr std::size_t shown_bytes = 60;

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", printable(text, shown_bytes)); }

// Tells how far the parser has read: its events do not.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char** read_to) : at_(at), read_to_(read_to) {}
  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *read_to_ = ++at_;
    return *this;
  }
  Cursor operator++(int) {
    const Cursor before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Cursor& a, const Cursor& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  const char** read_to_;
};

// Builds the value. An event that returns false ends the parsing; then `flaw` says why.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(std::size_t depth) : depth_(depth) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // not in text
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    if (open_.back()->contains(key)) {
      flaw = "the field \"" + printable(key, shown_bytes) + "\" is there twice";
      return false;
    }
    member_ = &(*open_.back())[key];
    return true;
  }

  bool parse_error(std::size_t, const std::string& last_token, const nlohmann::detail::exception& error) override {
    constexpr int number_out_of_range = 406;
    flaw = error.id == number_out_of_range ? "the number " + in_quotes(last_token) + " is too large for a double"
           : std::string_view(error.what()).find("unexpected end of input") != std::string_view::npos
               ? "this is not JSON: it ends too early"
               : "this is not JSON: wrong at " + in_quotes(last_token);
    return false;
  }

  Json root;
  std::string flaw;

 private:
  Json* place(Json&& value) {
    if (open_.empty()) {
      root = std::move(value);
      return &root;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    *member_ = std::move(value);
    return member_;
  }

  template <class Value>
  bool put(Value&& value) {
    place(Json(std::forward<Value>(value)));
    return true;
  }

  bool open(Json&& value) {
    if (open_.size() == depth_) {
      flaw = fmt::format("lists and objects are nested more than {} deep", depth_);
      return false;
    }
    open_.push_back(place(std::move(value)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::size_t depth_;
  std::vector<Json*> open_;  // from the outermost in; each is the last item of the one before, so that none moves
  Json* member_ = nullptr;   // whose key was read
};

// Of what was read last. The parser may have read one byte more than it speaks of, the end of a number.
std::uint64_t line_of(std::string_view text, const char* read_to) {
  const char* const end = read_to > text.data() ? read_to - 1 : text.data();
  return 1 + static_cast<std::uint64_t>(std::count(text.data(), end, '\n'));
}

}  // namespace

Json parse_json_text(std::string_view text, const JsonLimits& limits) {
  if (text.size() > limits.bytes) {
    throw JsonError(0, fmt::format("{} bytes of JSON are more than the {} that are read", text.size(), limits.bytes));
  }
  // The parser would take a NUL for the end.
  if (const auto nul = text.find('\0'); nul != std::string_view::npos) {
    throw JsonError(line_of(text, text.data() + nul + 1), "this is not JSON: it holds a NUL byte");
  }
  const char* read_to = text.data();
  Builder builder(limits.depth);
  const Cursor begin(text.data(), &read_to), end(text.data() + text.size(), &read_to);
  if (!Json::sax_parse(begin, end, &builder)) throw JsonError(line_of(text, read_to), builder.flaw);
  return std::move(builder.root);
}

Json parse_json(std::string_view text, const std::string& file, const JsonLimits& limits) {
  try {
    return parse_json_text(text, limits);
  } catch (const JsonError& error) {
    const auto what = std::string(error.what()) + "; correct the file, or write it again";
    if (error.line() == 0) fail_in(file, ErrorCode::malformed, what);
    fail_at({file, {}, error.line()}, ErrorCode::malformed, what);
  }
}

Json read_json_file(const std::filesystem::path& path, const JsonLimits& limits) {
  return parse_json(read_file_bytes(path), path.string(), limits);
}

std::uint64_t whole_number(const Json& value, std::string_view what, std::uint64_t most) {
  if (!value.is_number_unsigned()) {
    throw JsonError(0, fmt::format("{} is {}; it must be a whole number from 0 up", what, json_excerpt(value)));
  }
  const auto number = value.get<std::uint64_t>();
  if (number > most) throw JsonError(0, fmt::format("{} is {}; it must be at most {}", what, number, most));
  return number;
}

std::string json_excerpt(const Json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  return value.is_string() ? in_quotes(value.get_ref<const std::string&>()) : value.dump();
}

}  // namespace clues::scene
