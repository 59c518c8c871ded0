// D1: collects points and faces in file order; fans polygons; refuses what is not a scene.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scene/formats/place.h"
#include "scene/mesh/mesh.h"

namespace clues::scene {

class MeshBuilder {
 public:
  // index_base: what the format calls its first vertex (OBJ 1, others 0); only for messages.
  MeshBuilder(std::string_view file, int index_base) : file_(file), index_base_(index_base) {}

  std::size_t point_count() const { return mesh_.points.size(); }

  // Throws non_finite; unsupported past 2^32-1 points.
  void add_point(const Point& point, const Place& place);

  // Corners count from 0, whatever the format. A face with one or two corners is no surface: left out, with a warning from take(); it has its number
  // all the same. Throws malformed without corners, index_out_of_range for what no file can hold; that a corner has a vertex is checked in take(),
  // because the vertex may come later.
  void add_face(std::span<const std::int64_t> corners, const Place& place);

  // Throws index_out_of_range at the first face with a corner past the last vertex.
  TriangleMesh take();

 private:
  [[noreturn]] void fail_index(std::int64_t corner, const Place& place) const;

  std::string_view file_;
  int index_base_;
  TriangleMesh mesh_;
  std::string_view item_;                    // the places of the faces: what they count ...
  std::vector<std::uint64_t> face_numbers_;  // ... and their numbers
  std::string first_left_out_;
  std::uint64_t left_out_ = 0;
};

}  // namespace clues::scene
