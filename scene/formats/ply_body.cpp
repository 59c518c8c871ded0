// D1: values of a PLY body. Text is read to the nearest double (also for float properties), bytes exactly.
#include "scene/formats/ply_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/warning.h"

namespace clues::scene {
namespace {

// One item a line.
class AsciiBody : public PlyBody {
 public:
  AsciiBody(std::string_view file, std::string_view text, std::uint64_t first_line)
      : lines_(file, text, {.hash_comments = false}, first_line) {}

  void begin_item(std::string_view element, std::uint64_t number) override {
    if (!lines_.next()) {
      fail_at(place(), ErrorCode::malformed,
              fmt::format("the file ends before {} {}; it is truncated, export it again", element, number));
    }
    next_ = 0;
  }

  void end_item() override {
    if (next_ < lines_.tokens().size()) {
      fail_at(place(), ErrorCode::malformed,
              excerpt(lines_.tokens()[next_]) + " is more than the header declares for this line; correct it");
    }
  }

  void finish() override {
    if (lines_.next()) {
      fail_at(place(), ErrorCode::malformed, "more lines than the header counts; correct the counts");
    }
  }

  Place place() const override { return lines_.place(); }

  double read_double(PlyType, std::string_view name) override { return number_at(take(), name, place()); }

  std::int64_t read_integer(PlyType, std::string_view name) override {
    const auto token = take();
    const auto value = parse_integer(token);
    if (!value) {
      fail_at(place(), ErrorCode::malformed,
              fmt::format("the {} {} is not a whole number; correct it", name, excerpt(token)));
    }
    return *value;
  }

  void skip(PlyType, std::uint64_t count) override {
    for (std::uint64_t i = 0; i < count; ++i) take();
  }

 protected:
  bool has_left(PlyType, std::uint64_t count) const override { return count <= lines_.tokens().size() - next_; }

 private:
  std::string_view take() {
    if (next_ == lines_.tokens().size()) {
      fail_at(place(), ErrorCode::malformed, "the line has fewer values than the header declares; correct it");
    }
    return lines_.tokens()[next_++];
  }

  LineReader lines_;
  std::size_t next_ = 0;
};

class BinaryBody : public PlyBody {
 public:
  BinaryBody(std::string_view file, std::string_view bytes, std::endian order)
      : file_(file), rest_(bytes), swap_(order != std::endian::native) {}

  void begin_item(std::string_view element, std::uint64_t number) override {
    element_ = element;
    number_ = number;
  }

  void end_item() override {}

  void finish() override {
    if (rest_.find_first_not_of("\r\n \t") != std::string_view::npos)
      warn(fmt::format("{}: {} bytes after the last element were left out", file_, rest_.size()));
  }

  Place place() const override { return {file_, element_, number_}; }

  double read_double(PlyType type, std::string_view) override {
    if (type == PlyType::float32) return take<float>();
    if (type == PlyType::float64) return take<double>();
    return static_cast<double>(take_integer(type));
  }

  std::int64_t read_integer(PlyType type, std::string_view) override { return take_integer(type); }

  void skip(PlyType type, std::uint64_t count) override {
    if (!has_left(type, count)) fail_truncated();
    rest_.remove_prefix(size_of(type) * count);
  }

 protected:
  bool has_left(PlyType type, std::uint64_t count) const override { return count <= rest_.size() / size_of(type); }

 private:
  [[noreturn]] void fail_truncated() const {
    fail_at(place(), ErrorCode::malformed, "the file ends here; it is truncated, export it again");
  }

  template <class Value>
  Value take() {
    if (rest_.size() < sizeof(Value)) fail_truncated();
    std::array<char, sizeof(Value)> bytes{};
    std::memcpy(bytes.data(), rest_.data(), sizeof(Value));
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    rest_.remove_prefix(sizeof(Value));
    return std::bit_cast<Value>(bytes);
  }

  std::int64_t take_integer(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
      case PlyType::float64:
        break;
    }
    throw Error(ErrorCode::internal, "a PLY float read as an integer");
  }

  std::string_view file_;
  std::string_view rest_;
  std::string_view element_;
  std::uint64_t number_ = 0;
  bool swap_;
};

}  // namespace

std::uint64_t PlyBody::read_length(const PlyProperty& property) {
  const auto length = read_integer(property.count_type, "length of a list");
  if (length < 0) fail_at(place(), ErrorCode::malformed, fmt::format("a list of {} entries; correct it", length));
  if (!has_left(property.type, static_cast<std::uint64_t>(length))) {
    fail_at(place(), ErrorCode::malformed,
            fmt::format("a list says {} entries, but fewer follow; the file is truncated or wrong", length));
  }
  return static_cast<std::uint64_t>(length);
}

std::unique_ptr<PlyBody> make_ply_body(const PlyHeader& header, std::string_view bytes, std::string_view file) {
  const auto body = bytes.substr(header.size);
  if (header.format == PlyFormat::ascii) return std::make_unique<AsciiBody>(file, body, header.body_line);
  const bool little = header.format == PlyFormat::binary_little_endian;
  return std::make_unique<BinaryBody>(file, body, little ? std::endian::little : std::endian::big);
}

}  // namespace clues::scene
