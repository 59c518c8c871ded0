// D1 from binary OFF: 32-bit integers and floats, the high byte first.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "scene/formats/line_reader.h"
#include "scene/formats/mesh_builder.h"
#include "scene/formats/off_header.h"
#include "scene/messages/warning.h"

namespace clues::scene {
namespace {

class BigEndianWords {
 public:
  BigEndianWords(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  std::uint32_t take() {
    if (rest_.size() < 4) fail_at(place_, ErrorCode::malformed, "the file ends here; it is truncated, export it again");
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(rest_[i]);
    rest_.remove_prefix(4);
    return word;
  }
  double take_float() { return std::bit_cast<float>(take()); }

  // A number of things that have at least so many words each.
  std::uint32_t take_count(const char* what, std::uint64_t words_each) {
    const auto count = take();
    if (count * words_each * 4 > rest_.size()) {
      fail_at(
          place_, ErrorCode::malformed,
          fmt::format("{} {} do not fit into the file; it is truncated, or its low bytes come first: export it again",
                      count, what));
    }
    return count;
  }

  void begin(const char* item, std::uint64_t number) { place_ = {file_, item, number}; }
  const Place& place() const { return place_; }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  const std::string& file_;
  Place place_{file_, "header", 0};
};

std::string_view first_line(std::string_view bytes) { return bytes.substr(0, bytes.find('\n')); }

}  // namespace

bool is_binary_off(std::string_view bytes) {
  LineReader words("", first_line(bytes), {});
  return words.next() && words.tokens().size() == 2 && words.tokens()[0].ends_with("OFF") &&
         words.tokens()[1] == "BINARY" && first_line(bytes).size() < bytes.size();
}

TriangleMesh read_binary_off(std::string_view bytes, const std::string& file) {
  LineReader keyword(file, first_line(bytes), {});
  keyword.next();
  const int extras = off_extras(keyword.tokens()[0], keyword.place());
  BigEndianWords words(bytes.substr(first_line(bytes).size() + 1), file);
  const auto vertices = words.take_count("vertices", 3), faces = words.take_count("faces", 2);
  words.take();  // edges
  MeshBuilder builder(file, 0);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    words.begin("vertex", i);
    Point point{};
    for (double& x : point) x = words.take_float();
    for (int extra = 0; extra < extras; ++extra) words.take();
    builder.add_point(point, words.place());
  }
  std::vector<std::int64_t> corners;
  for (std::uint32_t i = 0; i < faces; ++i) {
    words.begin("face", i);
    corners.resize(words.take_count("corners", 1));
    for (auto& corner : corners) corner = static_cast<std::int32_t>(words.take());
    for (auto colours = words.take_count("numbers of a colour", 1); colours > 0; --colours) words.take();
    builder.add_face(corners, words.place());
  }
  if (words.left() > 0) warn(fmt::format("{}: {} bytes after the last face were left out", file, words.left()));
  return builder.take();
}

}  // namespace clues::scene
