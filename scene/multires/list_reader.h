// Texts of lists, as of clues maps: each list begins with a line of its name and its length, and each entry is a line; tokens are asked for by
// what they are. Errors name file and line.
#pragma once

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "scene/formats/line_reader.h"
#include "scene/formats/number.h"
#include "scene/messages/error.h"
#include "scene/multires/hierarchy.h"

namespace clues::scene {

// A line after the other, each token asked for by what it is.
class ListReader {
 public:
  ListReader(const std::string& file, std::string_view text) : lines_(file, text, {}), limit_(text.size()) {}

  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::malformed) const {
    fail_at(lines_.place(), code, what);
  }
  void next_line(std::string_view wanted) {
    if (!lines_.next()) fail(fmt::format("the file ends where {} was expected", wanted));
    at_ = 0;
  }
  void end_line() {
    if (at_ != lines_.tokens().size()) fail(fmt::format("{} is one word too many", excerpt(lines_.tokens()[at_])));
  }
  void end_file() {
    if (lines_.next()) fail("nothing was expected after the end");
  }
  std::string_view word(std::string_view what) {
    if (at_ == lines_.tokens().size()) fail(fmt::format("{} is missing at the end of the line", what));
    return lines_.tokens()[at_++];
  }
  std::int64_t integer(std::string_view what) {
    const std::string_view token = word(what);
    const auto value = parse_integer(token);
    if (!value) fail(fmt::format("{} is no whole number ({})", excerpt(token), what));
    return *value;
  }
  std::uint32_t index(std::string_view what, std::size_t count) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) >= count) {
      fail(fmt::format("{} {} does not exist; there are {}", what, value, count), ErrorCode::index_out_of_range);
    }
    return static_cast<std::uint32_t>(value);
  }
  // Nothing in a file can be more than it has characters.
  std::size_t count(std::string_view what) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > limit_) fail(fmt::format("{} {} is no count", what, value));
    return static_cast<std::size_t>(value);
  }
  std::size_t heading(std::string_view name) {
    next_line(name);
    if (const auto found = word(name); found != name)
      fail(fmt::format("{} stands where '{}' was expected", excerpt(found), name));
    return count(name);
  }
  double number(std::string_view what) { return number_at(word(what), what, lines_.place()); }
  std::size_t name(const std::array<std::string_view, 3>& names, std::string_view what) {
    const std::string_view token = word(what);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] == token) return k;
    }
    fail(fmt::format("{} is no {}", excerpt(token), what));
  }
  Triangle triangle(std::size_t vertices) {
    Triangle t{};
    for (auto& v : t) v = index("vertex", vertices);
    return t;
  }
  CarrierPoint point(std::size_t vertices) {
    CarrierPoint out;
    const std::size_t size = count("corners");
    if (size < 1 || size > 3) fail("a point has 1 to 3 corners");
    for (std::size_t k = 0; k < size; ++k) {
      out.corner[k] = index("vertex", vertices);
      if (k > 0 && out.corner[k] <= out.corner[k - 1]) fail("the corners of a point have to ascend");
      out.weight[k] = integer("weight");
    }
    return out;
  }
  // A list: its heading, then an entry a line.
  template <typename ReadEntry>
  void list(std::string_view name, const ReadEntry& read) {
    const std::size_t count = heading(name);
    end_line();
    for (std::size_t k = 0; k < count; ++k) {
      next_line(name);
      read();
      end_line();
    }
  }

 private:
  LineReader lines_;
  std::size_t limit_;
  std::size_t at_ = 0;
};

// The number of corners, and for each the vertex and its weight.
inline void write_point(fmt::memory_buffer& out, const CarrierPoint& point) {
  fmt::format_to(std::back_inserter(out), "{}", point.size());
  for (std::size_t k = 0; k < point.size(); ++k) {
    fmt::format_to(std::back_inserter(out), " {} {}", point.corner[k], point.weight[k]);
  }
}

// The lists that ListReader::list() reads with triangle(), and with point() twice.
inline void write_triangles(fmt::memory_buffer& out, std::string_view name, const std::vector<Triangle>& triangles) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{} {}\n", name, triangles.size());
  for (const auto& t : triangles) fmt::format_to(to, "{} {} {}\n", t[0], t[1], t[2]);
}
inline void write_points(fmt::memory_buffer& out, const std::vector<OverlayVertex>& points) {
  fmt::format_to(std::back_inserter(out), "points {}\n", points.size());
  for (const auto& p : points) {
    write_point(out, p.source);
    out.push_back(' ');
    write_point(out, p.image);
    out.push_back('\n');
  }
}

}  // namespace clues::scene
