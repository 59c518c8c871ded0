// The words of vectors/schema.json: what its "pattern" fields say, as functions. O(length).
#pragma once

#include <string_view>

namespace clues::validate {

bool is_slug(std::string_view text);        // "edge-grazes-target"
bool is_flag(std::string_view text);        // "EdgeGraze"
bool is_definition(std::string_view text);  // "D5", "D13a, T1"
bool is_hazard(std::string_view text);      // "B-7"
bool is_month(std::string_view text);       // "2026-11"
bool is_hex_float(std::string_view text);   // "-0x1.8p+1"
bool is_rational(std::string_view text);    // "-5/7", "0"; whether in lowest terms is not looked at

}  // namespace clues::validate
