#include "scene/ply_text.h"

#include <fmt/format.h>

#include <iterator>

namespace clues::scene {

PlyText::PlyText(std::uint64_t vertices, std::uint64_t faces, const PlyLayout& layout) : floats_(layout.floats) {
  text_ = "ply\nformat ascii 1.0\n";
  const auto to = std::back_inserter(text_);
  if (!layout.comment.empty()) fmt::format_to(to, "comment {}\n", layout.comment);
  fmt::format_to(to, "element vertex {}\n", vertices);
  for (const char axis : {'x', 'y', 'z'}) fmt::format_to(to, "property {} {}\n", floats_ ? "float" : "double", axis);
  fmt::format_to(to, "{}element face {}\nproperty list uchar int vertex_indices\n{}end_header\n", layout.of_vertex,
                 faces, layout.of_face);
}

void PlyText::vertex(const Point& at, std::initializer_list<std::uint32_t> values) {
  const auto to = std::back_inserter(text_);
  if (floats_) {
    fmt::format_to(to, "{:.7g} {:.7g} {:.7g}", at[0], at[1], at[2]);
  } else {
    fmt::format_to(to, "{} {} {}", at[0], at[1], at[2]);
  }
  finish_line(values);
}

void PlyText::face(const std::array<std::uint64_t, 3>& corners, std::initializer_list<std::uint32_t> values) {
  fmt::format_to(std::back_inserter(text_), "3 {} {} {}", corners[0], corners[1], corners[2]);
  finish_line(values);
}

void PlyText::finish_line(std::initializer_list<std::uint32_t> values) {
  for (const std::uint32_t value : values) fmt::format_to(std::back_inserter(text_), " {}", value);
  text_ += '\n';
}

}  // namespace clues::scene
