// SHA-256 of bytes and of files; that of a scene (D1) is made of these in scene/scenes/scene_identity.cpp.
#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "scene/formats/file_bytes.h"
#include "scene/messages/error.h"
#include "scene/result.h"

namespace clues::scene {

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw Error(ErrorCode::internal, "OpenSSL cannot compute SHA-256; check its installation");
  }
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_of_file(const std::filesystem::path& path) { return sha256_of(read_file_bytes(path)); }

}  // namespace clues::scene
