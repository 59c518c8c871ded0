#include "scene/bakes/packed_list.h"

#include <zstd.h>

#include "scene/messages/error.h"

namespace clues::scene {
namespace {

constexpr int level = 9;  // higher ones save nothing on lists

[[noreturn]] void fail(const std::string& where, const char* what) {
  throw Error(ErrorCode::malformed, where + ": " + what + "; the store was damaged");
}

}  // namespace

std::string packed_bytes(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const auto size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0)
    throw Error(ErrorCode::unsupported, std::string("cannot pack a list: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

std::string packed_list(const std::vector<std::uint32_t>& list, std::uint32_t triangles) {
  std::string bits((triangles + 7) / 8, '\0');
  for (const auto t : list) bits[t / 8] = static_cast<char>(static_cast<unsigned char>(bits[t / 8]) | 1U << t % 8);
  return packed_bytes(bits);
}

std::vector<std::uint32_t> unpacked_list(const std::string& bytes, std::uint32_t triangles, const std::string& where) {
  std::string bits((triangles + 7) / 8, '\0');
  if (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != bits.size()) fail(where, "a list of another length");
  if (ZSTD_decompress(bits.data(), bits.size(), bytes.data(), bytes.size()) != bits.size())
    fail(where, "a list that cannot be unpacked");
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    for (std::uint32_t k = 0; k < 8; ++k) {
      if ((static_cast<unsigned char>(bits[i]) >> k & 1U) == 0) continue;
      const auto t = static_cast<std::uint32_t>(8 * i + k);
      if (t >= triangles) fail(where, "a triangle that the scene does not have");
      list.push_back(t);
    }
  }
  return list;
}

}  // namespace clues::scene
