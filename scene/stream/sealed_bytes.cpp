#include "scene/stream/sealed_bytes.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::scene {
namespace {

void require_magic(const SealedKind& kind, std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with(kind.magic))
    throw Error(ErrorCode::malformed,
                fmt::format("{}: is no file of {}, which begins with {}", where, kind.what, kind.magic));
}

}  // namespace

std::string bytes_of_hash(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i < hash_bytes; ++i)
    bytes += static_cast<char>(std::stoul(std::string(digits.substr(2 * i, 2)), nullptr, 16));
  return bytes;
}

std::string digits_of_hash(std::string_view bytes) {
  std::string digits;
  for (const char c : bytes.substr(0, hash_bytes)) digits += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return digits;
}

VarintWriter begun(const SealedKind& kind) {
  VarintWriter out;
  out.bytes = kind.magic;
  out.raw(kind.version, 4);
  return out;
}

std::string sealed_bytes(std::string bytes) {
  bytes += bytes_of_hash(sha256_of(bytes));
  return bytes;
}

std::string_view opened_bytes(const SealedKind& kind, std::string_view bytes, const std::string& where) {
  require_magic(kind, bytes, where);
  const std::size_t size = std::max(bytes.size(), hash_bytes) - hash_bytes;
  if (bytes_of_hash(sha256_of(bytes.substr(0, size))) != bytes.substr(size))
    throw Error(ErrorCode::malformed, where + ": is cut short or was changed: its SHA-256 is not the one in its end");
  return bytes.substr(0, size);
}

VarintReader begin_reading(const SealedKind& kind, std::string_view bytes, const std::string& where) {
  require_magic(kind, bytes, where);
  VarintReader in(bytes.substr(kind.magic.size()), where);
  if (const std::uint64_t version = in.raw(4); version != kind.version)
    throw Error(ErrorCode::unsupported, fmt::format("{}: {} of version {}; this program reads version {}", where,
                                                    kind.what, version, kind.version));
  return in;
}

}  // namespace clues::scene
