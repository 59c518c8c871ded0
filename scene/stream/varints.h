// Numbers of seven bits a byte, the lowest first, and others of a fixed size, for contours.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/messages/error.h"

namespace clues::scene {

class VarintWriter {
 public:
  void number(std::uint64_t x) {
    for (; x >= 0x80; x >>= 7) bytes.push_back(static_cast<char>(0x80 | (x & 0x7f)));
    bytes.push_back(static_cast<char>(x));
  }
  void raw(std::uint64_t x, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(x >> (8 * i) & 0xff));
  }
  void real(double x) { raw(std::bit_cast<std::uint64_t>(x), 8); }
  void text(const std::string& text) {
    number(text.size());
    bytes += text;
  }
  std::string bytes;
};

// Throws Error malformed where there is not enough, or a number is not below what it must be; non_finite.
class VarintReader {
 public:
  explicit VarintReader(std::string_view bytes, std::string where = "contours")
      : rest_(bytes), where_(std::move(where)) {}

  [[noreturn]] void fail(const std::string& what = "cut short, or a number that there is none") const {
    throw Error(ErrorCode::malformed, where_ + ": " + what);
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
  // How many items of at least one byte each follow.
  std::uint64_t count() { return number(rest_.size() + 1); }
  std::uint64_t raw(std::size_t size) {
    if (rest_.size() < size) fail();
    std::uint64_t x = 0;
    for (std::size_t i = 0; i < size; ++i) x |= std::uint64_t{static_cast<unsigned char>(rest_[i])} << (8 * i);
    rest_.remove_prefix(size);
    return x;
  }
  double real() {
    const double x = std::bit_cast<double>(raw(8));
    if (!std::isfinite(x)) throw Error(ErrorCode::non_finite, where_ + ": a coordinate is no finite number");
    return x;
  }
  std::string bytes(std::size_t size) {
    if (size > rest_.size()) fail();
    std::string bytes(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return bytes;
  }
  std::string text() { return bytes(count()); }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  std::string where_;
};

// Numbers that ascend: how many, the first, and then differences less 1.
template <class Number>
void write_ascending(const std::vector<Number>& numbers, VarintWriter& out) {
  out.number(numbers.size());
  std::uint64_t least = 0;
  for (const std::uint64_t x : numbers) {
    out.number(x - least);
    least = x + 1;
  }
}

template <class Number>
void read_ascending(VarintReader& in, std::uint64_t below, std::vector<Number>& numbers) {
  std::uint64_t least = 0;
  for (std::uint64_t n = in.count(); n > 0; --n) {
    numbers.push_back(static_cast<Number>(least + in.number(below - least)));
    least = numbers.back() + std::uint64_t{1};
  }
}

}  // namespace clues::scene
