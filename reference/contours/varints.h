// Numbers of seven bits a byte, the lowest first, and others of a fixed size, for contours.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/messages/error.h"

namespace clues::reference {

class VarintWriter {
 public:
  void number(std::uint64_t x) {
    for (; x >= 0x80; x >>= 7) bytes.push_back(static_cast<char>(0x80 | (x & 0x7f)));
    bytes.push_back(static_cast<char>(x));
  }
  void raw(std::uint64_t x, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(x >> (8 * i) & 0xff));
  }
  void text(const std::string& text) {
    number(text.size());
    bytes += text;
  }
  std::string bytes;
};

// Throws scene::Error malformed where there is not enough, or a number is not below what it must be.
class VarintReader {
 public:
  explicit VarintReader(std::string_view bytes) : rest_(bytes) {}

  [[noreturn]] static void fail() {
    throw scene::Error(scene::ErrorCode::malformed, "contours: cut short, or a number that there is none");
  }
  std::uint64_t number(std::uint64_t below) {
    std::uint64_t x = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint64_t byte = raw(1);
      if (shift > 56) fail();
      x |= (byte & 0x7f) << shift;
      if ((byte & 0x80) == 0) break;
    }
    if (x >= below) fail();
    return x;
  }
  std::uint64_t raw(std::size_t size) {
    if (rest_.size() < size) fail();
    std::uint64_t x = 0;
    for (std::size_t i = 0; i < size; ++i) x |= std::uint64_t{static_cast<unsigned char>(rest_[i])} << (8 * i);
    rest_.remove_prefix(size);
    return x;
  }
  std::string text() {
    const std::uint64_t size = number(rest_.size() + 1);
    if (size > rest_.size()) fail();
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

}  // namespace clues::reference
