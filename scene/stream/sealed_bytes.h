// Binary files end with the SHA-256 of all that stands before, so that what was cut short or changed is seen.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clues::scene {

inline constexpr std::size_t hash_bytes = 32;

// 64 hex digits as 32 bytes, and back.
std::string bytes_of_hash(std::string_view digits);
std::string digits_of_hash(std::string_view bytes);

std::string sealed_bytes(std::string bytes);
// Without the hash. Throws Error malformed where it is another one.
std::string_view opened_bytes(std::string_view bytes, const std::string& where);

}  // namespace clues::scene
