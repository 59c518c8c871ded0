// Binary files that say what they are in their first eight bytes, and in which version, and end with the SHA-256 of all
// that stands before, so that what was cut short or changed is seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/stream/varints.h"

namespace clues::scene {

struct SealedKind {
  const char* what;  // "contours"
  std::string_view magic;
  std::uint32_t version;
};

inline constexpr std::size_t hash_bytes = 32;

// 64 hex digits as 32 bytes, and back.
std::string bytes_of_hash(std::string_view digits);
std::string digits_of_hash(std::string_view bytes);

VarintWriter begun(const SealedKind& kind);  // magic bytes and version are written
std::string sealed_bytes(std::string bytes);

// Without the hash. Throws Error malformed where it is another one, or the file of another kind.
std::string_view opened_bytes(const SealedKind& kind, std::string_view bytes, const std::string& where);
// Behind the version, of bytes without a hash. Throws Error malformed for another kind, unsupported for another version.
VarintReader begin_reading(const SealedKind& kind, std::string_view bytes, const std::string& where);

}  // namespace clues::scene
