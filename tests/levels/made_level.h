// A level of two rooms, byte by byte, that tests change before they write it down: one floor of two faces over a slab, a sheet of glass between
// the rooms, a patch, a billboard, a face that is not drawn, and a door that moves.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "scene/mesh/mesh.h"

namespace clues::tests {

struct MadeLevel {
  std::array<std::string, 17> lumps;
  std::uint32_t version = 46;

  std::string bytes() const;
  void put_word(std::size_t lump, std::size_t word, std::uint32_t value);
  void put_float(std::size_t lump, std::size_t word, float value);

  void add_shader(const std::string& name, std::uint32_t surface, std::uint32_t contents);
  void add_plane(float x, float y, float z, float distance);
  void add_vertex(const scene::Point& p);
  // A quadrilateral of the last four vertices.
  void add_quad(std::uint32_t shader, std::uint32_t kind = 1);
  void add_patch(std::uint32_t shader, std::uint32_t columns, std::uint32_t rows);  // of the last vertices
  void add_brush_box(const scene::Point& low, const scene::Point& high, std::uint32_t shader);
  void add_model(std::uint32_t first_face, std::uint32_t faces, std::uint32_t first_brush, std::uint32_t brushes);
  std::uint32_t count(std::size_t lump, std::size_t record) const;
};

// Lumps by the number in the file.
inline constexpr std::size_t entities_lump = 0, shaders_lump = 1, planes_lump = 2, nodes_lump = 3, leaves_lump = 4,
                             leaf_faces_lump = 5, models_lump = 7, brushes_lump = 8, sides_lump = 9, vertices_lump = 10,
                             corners_lump = 11, faces_lump = 13, visibility_lump = 16;

MadeLevel two_rooms();

// A slab whose floor (triangles 0 to 3) and ceiling (4 to 7) are drawn in two parts each that do not quite meet, one crack under the other, and a
// quadrilateral (8, 9) below: through the cracks it is seen from above where the sides of the slab's hull are left out.
MadeLevel cracked_slab();

}  // namespace clues::tests
