// Fields of JSON that others may have written: a number that is not whole, negative or too large is refused, and not made to fit.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace clues::fuzz {

// what() says what is wrong, not where: who reads a file adds its name.
class BadField : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class Number>
Number whole(const nlohmann::json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<Number>::max())
    throw BadField("a number is not whole, negative or too large");
  return value.get<Number>();
}

template <class Number>
Number whole_number(const nlohmann::json& object, const char* key) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<Number>::max())
    throw BadField(std::string("\"") + key + "\" is no whole number in its range");
  return value.get<Number>();
}

template <class Item, class Read>
std::array<Item, 3> three(const nlohmann::json& value, const Read& read) {
  if (!value.is_array() || value.size() != 3) throw BadField("where three numbers are needed there are more or fewer");
  return {read(value[0]), read(value[1]), read(value[2])};
}

inline std::array<std::string, 3> three_texts(const nlohmann::json& value) {
  return three<std::string>(value, [](const nlohmann::json& x) { return x.get<std::string>(); });
}

}  // namespace clues::fuzz
