#include "tests/levels/made_level.h"

#include <bit>

namespace clues::tests {
namespace {

void append_word(std::string& text, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
}
void append_float(std::string& text, double value) {
  append_word(text, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}
void append_words(std::string& text, std::initializer_list<std::int64_t> values) {
  for (const auto value : values) append_word(text, static_cast<std::uint32_t>(value));
}

}  // namespace

std::string MadeLevel::bytes() const {
  std::string text = "IBSP", content;
  append_word(text, version);
  for (const auto& lump : lumps) {
    append_word(text, static_cast<std::uint32_t>(144 + content.size()));
    append_word(text, static_cast<std::uint32_t>(lump.size()));
    content += lump + std::string((4 - lump.size() % 4) % 4, '\0');
  }
  return text + content;
}

void MadeLevel::put_word(std::size_t lump, std::size_t word, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) lumps[lump].at(4 * word + i) = static_cast<char>(value >> (8 * i) & 0xFF);
}
void MadeLevel::put_float(std::size_t lump, std::size_t word, float value) {
  put_word(lump, word, std::bit_cast<std::uint32_t>(value));
}

std::uint32_t MadeLevel::count(std::size_t lump, std::size_t record) const {
  return static_cast<std::uint32_t>(lumps[lump].size() / record);
}

void MadeLevel::add_shader(const std::string& name, std::uint32_t surface, std::uint32_t contents) {
  lumps[shaders_lump] += name + std::string(64 - name.size(), '\0');
  append_words(lumps[shaders_lump], {surface, contents});
}
void MadeLevel::add_plane(float x, float y, float z, float distance) {
  for (const float value : {x, y, z, distance}) append_float(lumps[planes_lump], value);
}
void MadeLevel::add_vertex(const scene::Point& p) {
  for (const double x : p) append_float(lumps[vertices_lump], x);
  lumps[vertices_lump] += std::string(32, '\0');
}
void MadeLevel::add_quad(std::uint32_t shader, std::uint32_t kind) {
  const auto first = count(corners_lump, 4);
  append_words(lumps[corners_lump], {0, 1, 2, 0, 2, 3});
  append_words(lumps[faces_lump], {shader, -1, kind, count(vertices_lump, 44) - 4, 4, first, 6});
  lumps[faces_lump] += std::string(76, '\0');
}
void MadeLevel::add_patch(std::uint32_t shader, std::uint32_t columns, std::uint32_t rows) {
  append_words(lumps[faces_lump], {shader, -1, 2, count(vertices_lump, 44) - columns * rows, columns * rows, 0, 0});
  lumps[faces_lump] += std::string(68, '\0');
  append_words(lumps[faces_lump], {columns, rows});
}
void MadeLevel::add_brush_box(const scene::Point& low, const scene::Point& high, std::uint32_t shader) {
  append_words(lumps[brushes_lump], {count(sides_lump, 8), 6, shader});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, 3> normal{};
    normal[axis] = 1;
    append_words(lumps[sides_lump], {count(planes_lump, 16), shader});
    add_plane(normal[0], normal[1], normal[2], static_cast<float>(high[axis]));
    append_words(lumps[sides_lump], {count(planes_lump, 16), shader});
    add_plane(-normal[0], -normal[1], -normal[2], static_cast<float>(-low[axis]));
  }
}
void MadeLevel::add_model(std::uint32_t first_face, std::uint32_t faces, std::uint32_t first_brush,
                          std::uint32_t brushes) {
  for (const double bound : {0, 0, -16, 256, 128, 128}) append_float(lumps[models_lump], bound);
  append_words(lumps[models_lump], {first_face, faces, first_brush, brushes});
}

MadeLevel two_rooms() {
  MadeLevel level;
  level.add_shader("textures/stone", 0, 1);           // 0: opaque
  level.add_shader("textures/glass", 0, 0x20000001);  // 1: translucent
  level.add_shader("textures/caulk", 0x80, 1);        // 2: opaque, not drawn
  level.add_shader("textures/crate", 0, 0x8000001);   // 3: opaque detail
  level.add_plane(1, 0, 0, 128);                      // between the rooms
  const auto quad = [&](std::initializer_list<scene::Point> points, std::uint32_t shader, std::uint32_t kind = 1) {
    for (const auto& p : points) level.add_vertex(p);
    level.add_quad(shader, kind);
  };
  quad({{0, 0, 0}, {128, 0, 0}, {128, 128, 0}, {0, 128, 0}}, 0);          // 0: floor of room 0
  quad({{128, 0, 0}, {256, 0, 0}, {256, 128, 0}, {128, 128, 0}}, 0);      // 1: floor of room 1
  quad({{128, 0, 0}, {128, 128, 0}, {128, 128, 128}, {128, 0, 128}}, 1);  // 2: the glass
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) level.add_vertex({200.0 + 8 * x, 32.0 + 8 * y, x == 1 ? 48.0 : 32.0});
  }
  level.add_patch(0, 3, 3);                                              // 3
  quad({{10, 10, 10}, {20, 10, 10}, {20, 20, 10}, {10, 20, 10}}, 0, 4);  // 4: a billboard
  quad({{0, 0, 0}, {0, 128, 0}, {0, 128, 128}, {0, 0, 128}}, 2);         // 5: not drawn
  quad({{40, 40, 8}, {60, 40, 8}, {60, 60, 8}, {40, 60, 8}}, 0, 3);      // 6: a mesh
  quad({{64, 0, 0}, {64, 32, 0}, {64, 32, 64}, {64, 0, 64}}, 0);         // 7: the door
  level.add_brush_box({0, 0, -16}, {256, 128, 0}, 0);                    // under the floor
  level.add_brush_box({0, -16, 0}, {256, 0, 128}, 2);                    // a wall of caulk
  level.add_brush_box({16, 16, 0}, {24, 24, 8}, 3);
  level.add_brush_box({127, 0, 0}, {129, 128, 128}, 1);
  level.add_brush_box({62, 0, 0}, {66, 32, 64}, 0);  // of the door
  level.add_model(0, 7, 0, 4);
  level.add_model(7, 1, 4, 1);
  append_words(level.lumps[nodes_lump], {0, -2, -1, 0, 0, 0, 0, 0, 0});
  append_words(level.lumps[leaves_lump], {0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0});  // leaf 0: behind
  append_words(level.lumps[leaves_lump], {1, 0, 0, 0, 0, 0, 0, 0, 4, 3, 0, 0});
  append_words(level.lumps[leaf_faces_lump], {0, 2, 4, 6, 1, 2, 3});
  append_words(level.lumps[visibility_lump], {2, 4});
  level.lumps[visibility_lump] +=
      std::string("\x01\0\0\0\x03\0\0\0", 8);  // room 1 sees both; room 0, wrongly, only itself
  return level;
}

MadeLevel cracked_slab() {
  MadeLevel level;
  level.add_shader("textures/stone", 0, 1);
  level.add_plane(1, 0, 0, 128);
  const auto quad = [&](double x0, double x1, double z) {
    for (const scene::Point& p : {scene::Point{x0, 0, z}, {x1, 0, z}, {x1, 128, z}, {x0, 128, z}}) level.add_vertex(p);
    level.add_quad(0);
  };
  for (const double z : {0.0, -16.0}) {
    quad(0, 128, z);
    quad(128 + 0x1p-10, 256, z);
  }
  quad(100, 156, -20);
  level.add_brush_box({0, 0, -16}, {256, 128, 0}, 0);
  level.add_model(0, 5, 0, 1);
  append_words(level.lumps[nodes_lump], {0, -2, -1, 0, 0, 0, 0, 0, 0});
  append_words(level.lumps[leaves_lump], {0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0});
  append_words(level.lumps[leaves_lump], {1, 0, 0, 0, 0, 0, 0, 0, 3, 2, 0, 0});
  append_words(level.lumps[leaf_faces_lump], {0, 2, 4, 1, 3});
  append_words(level.lumps[visibility_lump], {2, 4});
  level.lumps[visibility_lump] += std::string("\x03\0\0\0\x03\0\0\0", 8);
  return level;
}

}  // namespace clues::tests
