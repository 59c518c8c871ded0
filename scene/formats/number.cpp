// D1: text to the nearest double. std::from_chars does the usual decimal numbers; strtod_l (correctly rounded in
// glibc) does what from_chars leaves open: hex floats, and which of overflow and underflow "out of range" was.
#include "scene/formats/number.h"

#include <fmt/format.h>
#include <locale.h>
#include <stdlib.h>

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace clues::scene {
namespace {

locale_t plain_locale() {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  return plain;
}

bool has_hex_prefix(std::string_view digits) {
  return digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
}

ParsedNumber classified(double value) {
  return {std::isfinite(value) ? NumberKind::finite : NumberKind::non_finite, value};
}

// The caller has ruled out leading space and a second sign.
ParsedNumber parse_by_strtod(std::string_view unsigned_token) {
  const std::string text(unsigned_token);
  char* end = nullptr;
  const double value = strtod_l(text.c_str(), &end, plain_locale());
  if (end != text.c_str() + text.size()) return {};
  return classified(value);
}

ParsedNumber parse_unsigned(std::string_view token) {
  const bool starts_like_number = !token.empty() && (token[0] == '.' || (token[0] >= '0' && token[0] <= '9') ||
                                                     std::string_view("iInN").find(token[0]) != std::string_view::npos);
  if (!starts_like_number) return {};
  if (has_hex_prefix(token)) return parse_by_strtod(token);
  double value = 0;
  const char* const end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (stop != end) return {};
  if (code == std::errc::result_out_of_range) return parse_by_strtod(token);
  if (code != std::errc()) return {};
  return classified(value);
}

}  // namespace

ParsedNumber parse_number(std::string_view token) {
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  auto parsed = parse_unsigned(token);
  if (negative) parsed.value = -parsed.value;
  return parsed;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  if (token.starts_with('+')) {
    token.remove_prefix(1);
    if (token.starts_with('-')) return std::nullopt;
  }
  std::int64_t value = 0;
  const char* const end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (stop != end || code != std::errc()) return std::nullopt;
  return value;
}

double number_at(std::string_view token, std::string_view what, const Place& place) {
  const auto parsed = parse_number(token);
  if (parsed.kind == NumberKind::finite) return parsed.value;
  if (parsed.kind == NumberKind::non_finite) {
    fail_at(place, ErrorCode::non_finite,
            fmt::format("the {} {} is not a finite double; give a number below 1.8e308", what, excerpt(token)));
  }
  fail_at(place, ErrorCode::malformed, fmt::format("the {} {} is not a number; correct it", what, excerpt(token)));
}

}  // namespace clues::scene
