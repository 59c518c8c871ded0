// std::regex with the very patterns of the schema (ECMAScript in both).
#include "validate/certificates/words.h"

#include <regex>

namespace clues::validate {
namespace {

bool matches(std::string_view text, const std::regex& pattern) {
  return std::regex_match(text.begin(), text.end(), pattern);
}

}  // namespace

bool is_slug(std::string_view text) {
  static const std::regex pattern("[a-z0-9]+(-[a-z0-9]+)*");
  return matches(text, pattern);
}

bool is_flag(std::string_view text) {
  static const std::regex pattern("[A-Z][A-Za-z0-9]*");
  return matches(text, pattern);
}

bool is_definition(std::string_view text) {
  static const std::regex pattern("[DT][0-9]+[a-z]?(, [DT][0-9]+[a-z]?)*");
  return matches(text, pattern);
}

bool is_hazard(std::string_view text) {
  static const std::regex pattern("[AB]-[0-9]+");
  return matches(text, pattern);
}

bool is_month(std::string_view text) {
  static const std::regex pattern("[0-9]{4}-[0-9]{2}");
  return matches(text, pattern);
}

bool is_hex_float(std::string_view text) {
  static const std::regex pattern("-?0x[01](\\.[0-9a-f]+)?p[+-][0-9]+");
  return matches(text, pattern);
}

bool is_rational(std::string_view text) {
  // By hand: libstdc++'s regex recurses per character, and exact numbers can be long.
  const auto digits = [](std::string_view t) {
    return !t.empty() && t.front() != '0' && t.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (text == "0") return true;
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto slash = text.find('/');
  return digits(text.substr(0, slash)) && (slash == std::string_view::npos || digits(text.substr(slash + 1)));
}

}  // namespace clues::validate
