// D1: decimal and hexadecimal text to the nearest double (ties to even), whatever the locale; integers exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scene/formats/place.h"

namespace clues::scene {

enum class NumberKind { finite, non_finite, not_a_number };

struct ParsedNumber {
  NumberKind kind = NumberKind::not_a_number;
  double value = 0;
};

// [+-] decimal (1, .5, 1e-3) or hex float (0x1.8p+3). The whole token must be the number. nan, inf and what
// overflows a double (1e999) are non_finite; what is nearest to zero (1e-400) is zero.
ParsedNumber parse_number(std::string_view token);

// A whole number in [-2^63, 2^63), optionally with '+'; nothing when it is not one.
std::optional<std::int64_t> parse_integer(std::string_view token);

// As parse_number, but throws malformed or non_finite at the place. `what` names the value: "coordinate".
double number_at(std::string_view token, std::string_view what, const Place& place);

}  // namespace clues::scene
