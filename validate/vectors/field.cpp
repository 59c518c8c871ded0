#include "validate/vectors/field.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "scene/messages/printable.h"
#include "validate/certificates/words.h"

namespace clues::validate {

using nlohmann::json;
using scene::Error;
using scene::ErrorCode;

void Field::fail(const std::string& what) const {
  std::string text = where_->file + ": ";
  if (!where_->case_id.empty()) text += "case " + where_->case_id + ": ";
  throw Error(ErrorCode::malformed, text + (path_.empty() ? "" : path_ + ": ") + what);
}

const Field& Field::object(std::initializer_list<const char*> required,
                           std::initializer_list<const char*> optional) const {
  if (!value_->is_object()) fail("must be an object");
  for (const char* key : required) {
    if (!value_->contains(key)) fail(fmt::format("the field \"{}\" is missing", key));
  }
  if (required.size() == 0) return *this;
  for (const auto& [key, unused] : value_->items()) {
    const auto is = [&key = key](const char* known) { return key == known; };
    if (std::none_of(required.begin(), required.end(), is) && std::none_of(optional.begin(), optional.end(), is)) {
      fail(fmt::format("unknown field \"{}\"; the schema is closed", scene::printable(key, 80)));
    }
  }
  return *this;
}

Field Field::operator[](const char* key) const {
  return {value_->at(key), *where_, path_.empty() ? key : path_ + "." + key};
}

std::vector<std::pair<std::string, Field>> Field::members() const {
  std::vector<std::pair<std::string, Field>> all;
  for (const auto& [key, value] : value_->items()) all.emplace_back(key, (*this)[key.c_str()]);
  return all;
}

std::vector<Field> Field::array(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) fail("must be a list");
  if (value_->size() < least) fail(fmt::format("must have at least {} items, has {}", least, value_->size()));
  if (value_->size() > most) fail(fmt::format("must have at most {} items, has {}", most, value_->size()));
  std::vector<Field> items;
  for (std::size_t i = 0; i < value_->size(); ++i)
    items.emplace_back((*value_)[i], *where_, fmt::format("{}[{}]", path_, i));
  return items;
}

std::string Field::text() const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().empty()) fail("must be a text that is not empty");
  return value_->get<std::string>();
}

std::string Field::text(bool (*is_kind)(std::string_view), const char* kind) const {
  std::string found = text();
  if (!is_kind(found)) fail(fmt::format("\"{}\" is not {}", scene::printable(found, 80), kind));
  return found;
}

std::size_t Field::one_of(std::initializer_list<const char*> words) const {
  const std::string found = text();
  std::size_t i = 0;
  std::string list;
  for (const char* word : words) {
    if (found == word) return i;
    list += fmt::format("{}\"{}\"", i++ ? ", " : "", word);
  }
  fail(fmt::format("\"{}\" is none of {}", scene::printable(found, 80), list));
}

bool Field::flag() const {
  if (!value_->is_boolean()) fail("must be true or false");
  return value_->get<bool>();
}

std::uint64_t Field::number() const {
  if (!value_->is_number_unsigned()) fail("must be a whole number, at least 0");
  return value_->get<std::uint64_t>();
}

std::uint32_t Field::index(std::uint64_t limit, const char* of) const {
  const std::uint64_t i = number();
  if (i >= limit) fail(fmt::format("{} is out of range: there are {} {}", i, limit, of));
  return static_cast<std::uint32_t>(i);
}

scene::Point Field::point() const {
  scene::Point p{};
  const auto coordinates = array(3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto parsed = scene::parse_number(coordinates[i].text(is_hex_float, "a C99 hex float like 0x1.8p+1"));
    if (parsed.kind != scene::NumberKind::finite) coordinates[i].fail("is not a finite double");
    p[i] = parsed.value;
  }
  return p;
}

RationalPoint Field::rational_point() const {
  RationalPoint p;
  const auto coordinates = array(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = coordinates[i].text(is_rational, "an exact number: \"p/q\", or \"p\", without leading zeros");
  return p;
}

}  // namespace clues::validate
