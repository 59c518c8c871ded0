// Numbers as bytes, little-endian, in base64: what a page holds of meshes and lists.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace clues::app {

class Base64 {
 public:
  template <class Number>
  void put(Number value) {
    static_assert(std::endian::native == std::endian::little);
    const auto bytes = std::bit_cast<std::array<unsigned char, sizeof(Number)>>(value);
    for (const unsigned char byte : bytes) {
      held_ = (held_ << 8) | byte;
      if (++count_ == 3) flush();
    }
  }
  std::string take() {
    const int rest = count_;
    if (rest > 0) {
      held_ <<= 8 * (3 - rest);
      flush();
      for (int i = rest; i < 3; ++i) text_[text_.size() - static_cast<std::size_t>(3 - i)] = '=';
    }
    return std::move(text_);
  }

 private:
  void flush() {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int shift = 18; shift >= 0; shift -= 6) text_ += letters[(held_ >> shift) & 63];
    held_ = 0;
    count_ = 0;
  }
  std::string text_;
  std::uint32_t held_ = 0;
  int count_ = 0;
};

}  // namespace clues::app
