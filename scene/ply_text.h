// Writes triangle meshes with colours, numbers or kinds as ASCII PLY, for other people's viewers. Coordinates as they come back bit for bit.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "scene/mesh/mesh.h"

namespace clues::scene {

inline constexpr std::string_view ply_colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

struct PlyLayout {
  std::string_view comment{};  // one line; empty: none
  // What there is besides coordinates and corners: lines "property TYPE NAME\n".
  std::string_view of_vertex{};
  std::string_view of_face{};
  bool floats = false;  // seven digits: enough for pictures
};

class PlyText {
 public:
  PlyText(std::uint64_t vertices, std::uint64_t faces, const PlyLayout& layout);

  // So many, vertices first, each with the values that the layout names.
  void vertex(const Point& at, std::initializer_list<std::uint32_t> values = {});
  void face(const std::array<std::uint64_t, 3>& corners, std::initializer_list<std::uint32_t> values = {});
  std::string take() { return std::move(text_); }

 private:
  void finish_line(std::initializer_list<std::uint32_t> values);

  std::string text_;
  bool floats_;
};

}  // namespace clues::scene
